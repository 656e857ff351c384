sim = require 'sim'
function sysCall_init()
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2})
    sim.setObjectAlias(ball, 'Ball')
    joint = sim.createJoint(sim.joint_revolute_subtype, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(joint, 'Arm')
    eye = sim.createVisionSensor(2, {6, 4, 0, 0}, {0.01, 5, 1, 0.05, 0, 0, 0, 0, 0, 0, 0})
    sim.setObjectAlias(eye, 'Eye')
    sim.setObjectPosition(eye, {1, 0, 0.05})
end
function sysCall_sensing()
    local t = sim.getSimulationTime()
    sim.setObjectPosition(ball, {t, 0, 0.5})
    sim.setJointPosition(joint, t)
    print('at', t)
end
function sysCall_actuation()
    if sim.getSimulationTime() > 1.5 and not failed then
        failed = true
        error('oh')
    end
end
