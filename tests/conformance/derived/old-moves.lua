-- topic: old functions
-- as: sandbox
-- passes: 40
-- spec: vrep-era 4
sim = require 'sim'
local h = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'
function sysCall_thread()
    local d, t, p = sim.createDummy(0.01), sim.createDummy(0.01), sim.createPath(0x20)
    sim.setObjectPosition(t, {5, 0, 0})
    sim.insertPathCtrlPoints(p, 0, 0, 2, {0, 0, 0, 0, 0, 0, 1, 0, 1, 0.5, 0.5, 0.11, 0, 0, 0, 0, 0, 1, 0, 1, 0.5, 0.5})
    local t0
    local function report(left)
        print(string.format('left %.3f elapsed %.2f x %.3f', left, sim.getSimulationTime() - t0, sim.getObjectPosition(d)[1]))
        t0 = sim.getSimulationTime()
    end
    t0 = sim.getSimulationTime()
    report(sim.moveToPosition(d, -1, {0.11, 0, 0}, nil, 0.5))
    report(sim.moveToObject(d, t, 1, nil, 2))
    report(sim.followPath(d, p, 1, 0, 0.5))
    sim.stopSimulation()
end
]], 0, 'lua')
sim.setObjectAlias(h, 's')
