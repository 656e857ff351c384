-- as: simulation
-- passes: 60
-- engine: bullet278
-- spec: joints 7; position control that closes its whole error in a sub-step of 5 ms, against gravity, with light links before heavy ones
-- tol: 1e-4
-- topic: dynjoints
sim = require 'sim'

local masses = {0.1, 10, 0.1, 10, 0.1, 10}
local joints = {}

local function ghost(x, mass, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.05, 0.05})
    sim.setObjectPosition(shape, {x, 0, 1})
    sim.setShapeMass(shape, mass)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
    return shape
end

function sysCall_init()
    local parent = ghost(0, 1, false)
    for i, mass in ipairs(masses) do
        local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
        sim.setObjectPose(joint, sim.buildPose({0.2 * i - 0.1, 0, 1}, {-math.pi / 2, 0, 0}))
        sim.setObjectParent(joint, parent, true)
        parent = ghost(0.2 * i, mass, true)
        sim.setObjectParent(parent, joint, true)
        sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_position)
        sim.setEngineFloatParam(sim.bullet_joint_pospid1, joint, 1)
        sim.setJointTargetForce(joint, 1e5)
        joints[i] = joint
    end
end

local steps, worst = 0, 0

function sysCall_actuation()
    for i, joint in ipairs(joints) do sim.setJointTargetPosition(joint, steps >= 10 and (-1) ^ i * 0.5 or 0) end
end

function sysCall_sensing()
    steps = steps + 1
    if steps == 10 then
        for i, joint in ipairs(joints) do worst = math.max(worst, math.abs(sim.getJointPosition(joint))) end
        print(string.format('holds level to %.4f rad', worst))
        worst = 0
    elseif steps > 20 then
        for i, joint in ipairs(joints) do
            worst = math.max(worst, math.abs(sim.getJointPosition(joint) - (-1) ^ i * 0.5), math.abs(sim.getJointVelocity(joint)))
        end
    end
    if steps == 60 then print(string.format('at its target, and at rest, to %.4f', worst)) end
end
