-- as: simulation
-- passes: 30
-- engine: bullet278
-- spec: joints 5, dynamics 8; dependent joints of dynamic joints, joints moved or reset in a run
-- tol: 2e-3
-- topic: dynjoints
sim = require 'sim'

local function ghost(x, z, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
    return shape
end

local function hinge(base, z, master, offset, factor)
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    local child = ghost(0, z, true)
    sim.setObjectPosition(joint, {0, 0, z})
    sim.setObjectParent(joint, base, true)
    sim.setObjectParent(child, joint, true)
    if master then
        sim.setJointMode(joint, sim.jointmode_dependent, 0)
        sim.setJointDependency(joint, master, offset, factor)
    end
    return joint, child
end

function sysCall_init()
    local base = ghost(0, 1, false)
    master = hinge(base, 1)
    sim.setObjectInt32Param(master, sim.jointintparam_dynctrlmode, sim.jointdynctrl_velocity)
    sim.setJointTargetVelocity(master, 1)
    sim.setJointTargetForce(master, 100)
    first = hinge(base, 2, master, 0.5, 2)
    second, tip = hinge(base, 3, first, 0.1, -1)
    loose = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    third = hinge(base, 4, loose, 0.25, 1)
end

local steps = 0

function sysCall_actuation()
    if steps == 5 then sim.setJointPosition(loose, 0.5) end
    if steps == 12 then sim.setObjectPosition(second, {0, 0, 3.5}) end
    if steps == 14 then sim.resetDynamicObject(first) end
end

local function show(...)
    local texts = {}
    for _, value in ipairs{...} do texts[#texts + 1] = type(value) == 'number' and string.format('%.3f', value) or tostring(value) end
    print(table.concat(texts, ' '))
end

function sysCall_sensing()
    steps = steps + 1
    if steps ~= 4 and steps ~= 16 then return end
    show(sim.getJointPosition(master), sim.getJointPosition(first), sim.getJointPosition(second), sim.getJointPosition(third))
    show(sim.getJointVelocity(first), sim.getJointVelocity(second), sim.isDynamicallyEnabled(second), sim.getObjectPosition(tip)[3])
end
