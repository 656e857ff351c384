-- topic: old functions
-- as: customization
-- passes: 0
-- spec: vrep-era 2.3
sim = require 'sim'
function sysCall_init()
    local d = sim.createDummy(0.01)
    print(simAddObjectCustomData(d, 42, 'abc'), simGetObjectCustomData(d, 42))
    print(sim.readCustomStringData(d, '_oldObjectCustomData_42_'))
    print('[' .. simGetObjectCustomData(d, 7) .. ']')
    print(simAddObjectCustomData(d, 42, ''), '[' .. simGetObjectCustomData(d, 42) .. ']')
    print(simGetObjectCustomDataLength)
    local function try(...)
        local ok, e = pcall(...)
        print(ok, (tostring(e):gsub('^%-?%d+: ', '')))
    end
    try(simAddObjectCustomData, d, 'x', 'y')
    try(simAddObjectCustomData, d, 1)
    try(simAddObjectCustomData, 999998, 1, 'y')
end
