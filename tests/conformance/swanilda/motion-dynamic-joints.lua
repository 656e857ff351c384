-- as: simulation
-- passes: 80
-- spec: motion 2; joints that the physics moves get target positions, the others positions
-- tol: 1e-6
-- topic: motion
sim = require 'sim'

local function arm(mode)
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    local joint = sim.createJoint(sim.joint_revolute, mode, 0)
    sim.setObjectParent(joint, base, true)
    sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_position)
    local link = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectInt32Param(link, sim.shapeintparam_static, 0)
    sim.setObjectParent(link, joint, true)
    return joint
end

function sysCall_init() moved, driven = arm(sim.jointmode_kinematic), arm(sim.jointmode_dynamic) end

function sysCall_thread()
    sim.step() -- the physics takes over
    print('dynamic', sim.isDynamicallyEnabled(moved), sim.isDynamicallyEnabled(driven))
    sim.moveToConfig{joints = {moved, driven}, targetPos = {0.5, 0.25}, maxVel = {1, 1}, maxAccel = 2, maxJerk = 10}
    print('positions', string.format('%.6f', sim.getJointPosition(moved)), math.abs(sim.getJointPosition(driven) - 0.25) < 0.05)
    print('targets', string.format('%.6f %.6f', sim.getJointTargetPosition(moved), sim.getJointTargetPosition(driven)))
end
