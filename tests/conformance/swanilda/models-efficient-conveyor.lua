-- topic: modules
-- as: customization
-- passes: 0
-- loops: 40
-- tol: 1e-7
-- spec: models 5; a conveyor of one box: sizes, and the velocity of its surface
sim = require 'sim'

function sysCall_init()
    model = sim.createDummy(0.01)
    sim.setObjectOrientation(model, {0, 0, math.pi / 2})
    for _, name in ipairs{'forwarder', 'visible1', 'visible2'} do
        local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.5, 0.5, 0.5}, 0)
        sim.setObjectAlias(shape, name)
        sim.setObjectParent(shape, model, false)
    end
    -- The script is one of V-REP's kind of names: a global of the module's own.
    local script = sim.createScript(sim.scripttype_customization, "local belt = require('models.efficientConveyor_customization-3')")
    sim.setObjectParent(script, model)
    sim.initScript(script)
    forwarder = sim.getObject('./forwarder', {proxy = model})
end

local passes = 0

function sysCall_nonSimulation()
    passes = passes + 1
    if passes == 3 then
        for _, name in ipairs{'forwarder', 'visible1', 'visible2'} do
            local shape = sim.getObject('./' .. name, {proxy = model})
            print(name, sim.getShapeBB(shape), sim.getObjectPosition(shape, model)[3])
        end
        sim.startSimulation()
    end
end

function sysCall_actuation()
    local velocity = {}
    for i, axis in ipairs{'x', 'y', 'z'} do
        velocity[i] = string.format('%.7f', sim.getObjectFloatParam(forwarder, sim['shapefloatparam_init_velocity_' .. axis]) + 1e-12)
    end
    print(table.concat(velocity, ' '))
    sim.quitSimulator()
end
