-- as: simulation
-- passes: 24
-- engine: bullet278
-- spec: dynamics 10; thresholds of force and torque, consecutive violations, un-parenting by the script that is triggered
-- tol: 1e-6
-- topic: dynamics
sim = require 'sim'

local function ghost(x, y, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, y, 2})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
    return shape
end

-- Weight 9.81 N at a lever of 0.2 m: 1.962 N m.
local LEVER <const> = 0.2
local sensors, loads, calls = {}, {}, {}

local function hang(name, y, options, consecutive, force, torque, breaks)
    local sensor = sim.createForceSensor(options, {0, 1, consecutive, 0, 0}, {0.05, force, torque, 0, 0})
    sim.setObjectPosition(sensor, {0, y, 2})
    sim.setObjectParent(sensor, ghost(0, y, false), true)
    local load = ghost(LEVER, y, true)
    sim.setObjectParent(load, sensor, true)
    sensors[name], loads[name], calls[name] = sensor, load, {}
    local code = "sim = require 'sim' function sysCall_trigger(data) sim.callScriptFunction('triggered', %d, '%s', %s, data) end"
    local script = sim.createScript(sim.scripttype_simulation, code:format(sim.getScript(sim.handle_self), name, breaks), 0, 'lua')
    sim.setObjectParent(script, sensor, false)
    sim.initScript(script)
end

local NAMES <const> = {'force', 'torque', 'strong', 'off', 'interrupted', 'breaks'}

function sysCall_init()
    hang('force', 0, 1, 3, 9, 0.1, false)
    hang('torque', 1, 2, 2, 1, 1.9, false)
    hang('strong', 2, 3, 1, 9.9, 1.99, false)
    hang('off', 3, 0, 1, 1, 0.1, false)
    hang('interrupted', 4, 1, 4, 9, 10, false)
    hang('breaks', 5, 3, 5, 100, 1.9, true)
end

local steps = 0

function triggered(name, breaks, data)
    table.insert(calls[name], steps)
    if name == 'force' and #calls[name] == 1 then
        print('force', data.force[3], 'torque', data.torque[2], 'filtered', data.filteredForce[3], data.filteredTorque[2])
    end
    if breaks then sim.setObjectParent(loads[name], -1, true) end
end

function sysCall_actuation()
    steps = steps + 1
    -- Its load weighs nothing in every third step.
    if steps % 3 == 0 then sim.addForceAndTorque(loads.interrupted, {0, 0, 9.81}) end
end

function sysCall_sensing()
    if steps ~= 13 then return end
    for _, name in ipairs(NAMES) do print(name, 'at', table.concat(calls[name], ' ')) end
    print('the load that broke off', sim.getObjectParent(loads.breaks), 'fell', 2 - sim.getObjectPosition(loads.breaks)[3])
    print('its sensor', (sim.readForceSensor(sensors.breaks)), sim.isDynamicallyEnabled(sensors.breaks))
    print('another', (sim.readForceSensor(sensors.force)), sim.isDynamicallyEnabled(sensors.force))
end
