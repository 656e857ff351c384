-- topic: calls
-- as: sandbox
-- passes: 0
-- spec: calls 1
-- note: the func@path form is gone since 4.8
sim = require 'sim'
local SIMU, CUST = sim.scripttype_simulation, sim.scripttype_customization
local function mk(kind, alias, parent, code)
    local h = sim.createScript(kind, code, 0, 'lua')
    sim.setObjectAlias(h, alias)
    if parent then sim.setObjectParent(h, parent, true) end
    return h
end
local B = mk(CUST, 'b', nil, "function f() return 1 end")
sim.initScript(B)
print((pcall(sim.callScriptFunction, 'f@/b', sim.scripttype_customization)))
