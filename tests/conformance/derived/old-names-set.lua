-- topic: old names
-- as: sandbox
-- passes: 0
-- spec: vrep-era 1.2
sim = require 'sim'
local a, b = sim.createDummy(0.01), sim.createDummy(0.01)
local function try(h, n)
    local ok, e = pcall(sim.setObjectName, h, n)
    print(n, ok, ok and e or (tostring(e):gsub('^%-?%d+: ', '')))
end
try(a, 'arm')
try(a, 'arm')
try(b, 'arm')
try(b, 'arm#0')
try(b, 'arm#00')
try(b, '#1')
try(b, 'arm#')
try(b, 'my arm')
try(b, 'arm(2)')
try(b, '')
try(b, string.rep('x', 127))
