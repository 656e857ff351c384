-- topic: modules
-- as: customization
-- passes: 0
-- loops: 10
-- spec: models 5; settings that make no sense end the script of a conveyor with an error, and nothing else
sim = require 'sim'

local function poses(count)
    local t = {}
    for i = 1, count do table.move({math.cos(i / 3), 0, math.sin(i / 3), 0, 0, 0, 1}, 1, 7, #t + 1, t) end
    return t
end

local function conveyor(name, points, config)
    local path = sim.createPath(points, 2, 20, 0)
    local i = 0
    while sim.getObjectType(sim.getObjectChild(path, i)) ~= sim.sceneobject_script do i = i + 1 end
    sim.removeObjects{sim.getObjectChild(path, i)}
    sim.writeCustomTableData(path, '__config__', config)
    local script = sim.createScript(sim.scripttype_customization, "require('models." .. name .. "')")
    sim.setObjectParent(script, path)
    sim.initScript(script)
end

function sysCall_init()
    conveyor('conveyor_customization-3', poses(18), {beltElementWidth = 1e-12, beltElementSpacing = 0})
    conveyor('conveyor_customization-3', poses(18), {type = 2, rollerCnt = 1000000000})
    conveyor('conveyor_customization-3', poses(5), {type = 1})
    conveyor('conveyorSystem_customization-3', poses(4), {beltElementWidth = 0, beltElementSpacing = 0, border = false})
    conveyor('conveyorSystem_customization-3', poses(4), {borderElementLength = 1e-9})
end

local passes = 0

function sysCall_nonSimulation()
    passes = passes + 1
    if passes == 5 then
        print('goes on')
        sim.quitSimulator()
    end
end
