-- A model with a joint that a script moves and a camera: the scene of ros2_robot.py whose robot a TOML file describes.
sim = require 'sim'

function sysCall_init()
    local base = sim.createDummy(0.1)
    sim.setObjectAlias(base, 'Robot')
    local hinge = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(hinge, 'Hinge')
    sim.setObjectParent(hinge, base, true)
    local eye = sim.createVisionSensor(1 + 2, {32, 16, 0, 0}, {0.05, 5, 1, 0.02, 0, 0, 0, 0, 0, 0, 0})
    sim.setObjectAlias(eye, 'Eye')
    sim.setObjectParent(eye, hinge, true)
end
