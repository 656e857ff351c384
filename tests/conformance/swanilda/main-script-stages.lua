-- as: customization
-- passes: 5
-- spec: simulation 7, sensors 1.2, sensors 3.2; what the stages of a step of the default main script have done when others come
-- tol: 1e-6
-- topic: callbacks
sim = require 'sim'

local step = 0

local function proximitySensor(options)
    return sim.createProximitySensor(sim.proximitysensor_ray, 16, options, {3, 3, 2, 2, 1, 1, 0, 0},
        {0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.01, 0, 0})
end

local function visionSensor(options)
    return sim.createVisionSensor(options | 2, {4, 4, 0, 0}, {1, 9, 0.5, 0.1, 0, 0, 0, 0, 0, 0, 0})
end

-- The nearest distance each sensor saw, or - without a result.
local function readings()
    local detected, distance = sim.readProximitySensor(proximity)
    local result, packet = sim.readVisionSensor(vision)
    local function text(value) return string.format('%.3f', value) end
    return detected == 1 and text(distance) or '-', result >= 0 and text(1 + 8 * packet[5]) or '-'
end

local function say(what, ...)
    if step <= 2 then print(step, what, string.format('%.4f', sim.getJointPosition(joint)), string.format('%.4f', sim.getPathPosition(path)), ...) end
end

function sysCall_init()
    wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {20, 20, 2})
    proximity, vision = proximitySensor(0), visionSensor(0)
    explicit, explicitVision = proximitySensor(1), visionSensor(1)
    local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(ball, {50, 0, 0})
    sim.setObjectInt32Param(ball, sim.shapeintparam_static, 0)
    joint = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
    sim.setJointInterval(joint, false, {-5, 10})
    sim.createScript(sim.scripttype_simulation, ([[
        sim = require 'sim'
        function sysCall_actuation() end
        function sysCall_cleanup()
            print('cleanup of a simulation script', sim.readProximitySensor(%d) == 1, sim.readVisionSensor(%d) >= 0)
        end
    ]]):format(proximity, vision), 0, 'lua')
    path = sim.createPath(0x20)
    sim.insertPathCtrlPoints(path, 0, 0, 2, {0, 0, 0, 0, 0, 0, 1, 0, 1, 0.5, 0.5, 9, 0, 0, 0, 0, 0, 1, 0, 1, 0.5, 0.5})
end

-- The wall is 2 + step ahead of the sensors; joint and path get their velocities only now.
function sysCall_actuation()
    step = step + 1
    say('before', readings())
    sim.setObjectPosition(wall, {0, 0, 3 + step})
    if step == 1 then
        sim.setJointTargetVelocity(joint, 1, {}, 1)
        sim.setPathTargetNominalVelocity(path, 0.5)
    end
    say('actuation', readings())
end

function sysCall_dyn(data)
    if data.passCnt == 1 and not data.afterStep then say('dynamics', data.totalPasses, string.format('%.3f', data.dynStepSize), readings()) end
end

function sysCall_sensing()
    say('sensing', readings())
    if step == 3 then
        sim.handleProximitySensor(explicit)
        sim.handleVisionSensor(explicitVision)
    end
end

local function states()
    local function state(result) return result == -1 and 'none' or 'a result' end
    return state(sim.readProximitySensor(proximity)), state(sim.readVisionSensor(vision)),
        state(sim.readProximitySensor(explicit)), state(sim.readVisionSensor(explicitVision))
end

-- Its cleanup in the middle of the run; it starts again in the step that follows.
function sysCall_beforeMainScript()
    if step ~= 3 or over then return end
    over = true
    print('before the cleanup', states())
    sim.initScript(sim.getScript(sim.scripttype_main))
    print('after the cleanup', states())
end
