-- topic: dynjoints
-- as: simulation
-- passes: 14
-- spec: joints 7, dynamics 3.2
sim = require 'sim'
local function arm(x, solver)
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(base, {x, 0, 1})
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPose(joint, sim.buildPose({x, 0, 1}, {-math.pi / 2, 0, 0}))
    sim.setObjectParent(joint, base, true)
    sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_position)
    sim.setJointTargetForce(joint, 100)
    sim.setStringProperty(joint, 'rapier.solver', solver)
    local bar = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.05, 0.05})
    sim.setObjectPosition(bar, {x + 0.2, 0, 1})
    sim.setObjectInt32Param(bar, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(bar, sim.shapeintparam_respondable, 0)
    sim.setShapeMass(bar, 1)
    sim.setObjectParent(bar, joint, true)
    return joint, bar
end
local arms = {}
function sysCall_init()
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    print(sim.getStringProperty(joint, 'rapier.solver'))
    sim.setStringProperty(joint, 'rapier.solver', 'impulse')
    print(sim.getStringProperty(sim.copyPasteObjects({joint}, 0)[1], 'rapier.solver'))
    print(select(2, pcall(sim.setStringProperty, joint, 'rapier.solver', 'fast')))
    print(select(2, pcall(sim.setStringProperty, sim.createDummy(0.1), 'rapier.solver', 'exact')))
    for i, solver in ipairs{'exact', 'impulse'} do arms[i] = {arm(i, solver)} end
end
function sysCall_sensing()
    if sim.getSimulationTime() < 0.49 then return end
    for i, pair in ipairs(arms) do
        local force, height = sim.getJointForce(pair[1]), sim.getObjectPosition(pair[2])[3]
        print(math.abs(force - 1.962) < 0.02, math.abs(height - 1) < 0.01)
        arms[i] = nil
    end
end
