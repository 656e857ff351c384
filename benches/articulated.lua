-- A chain of boxes on hinges; the upper words are replaced by benches/articulated.rs.
sim = require 'sim'

local masses, target, joints, boxes = {MASSES}, TARGET, {}, {}
local direction = {math.sin(INCLINE), 0, math.cos(INCLINE)}
local ACROSS <const> = sim.buildPose({0, 0, 0}, {-math.pi / 2, 0, 0}) -- makes z the y of what it turns

local function at(distance) return {direction[1] * distance, 0, direction[3] * distance} end

local function box(size, distance, mass)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectPose(shape, sim.buildPose(at(distance), {0, INCLINE, 0}))
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, mass and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
    if mass then sim.setShapeMass(shape, mass) end
    return shape
end

function sysCall_init()
    local parent = box({0.01, 0.01, 0.01}, 0)
    for i, mass in ipairs(masses) do
        local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
        local pose = sim.buildPose(at(LENGTH * (i - 1)), {0, INCLINE, 0})
        local along = ALTERNATE and i % 2 == 1
        sim.setObjectPose(joint, along and pose or sim.multiplyPoses(pose, ACROSS))
        sim.setObjectParent(joint, parent, true)
        sim.setStringProperty(joint, 'rapier.solver', 'SOLVER')
        if target then
            sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_position)
            sim.setJointTargetForce(joint, 200)
            sim.setJointTargetPosition(joint, target)
        end
        parent = box({0.02, 0.02, LENGTH}, LENGTH * (i - 0.5), mass)
        sim.setObjectParent(parent, joint, true)
        joints[i], boxes[i] = joint, parent
    end
end

local function energy(shape, mass)
    local v, w = sim.getVelocity(shape)
    local inertia, m = sim.getShapeInertia(shape), sim.getObjectMatrix(shape)
    local own, e = {}, mass * 9.81 * m[12]
    for k = 1, 3 do own[k] = m[k] * w[1] + m[4 + k] * w[2] + m[8 + k] * w[3] end
    for i = 1, 3 do e = e + mass * v[i] ^ 2 / 2 + own[i] ^ 2 * inertia[4 * i - 3] / 2 end
    return e
end

function report()
    local gap, total, err, last = 0, 0, 0, {0, 0, 0}
    for i, shape in ipairs(boxes) do
        local m = sim.getObjectMatrix(shape)
        local square, far = 0, {}
        for k = 1, 3 do
            local centre, half = m[4 * k], m[4 * k - 1] * LENGTH / 2
            square = square + (centre - half - last[k]) ^ 2
            far[k] = centre + half
        end
        gap, last = math.max(gap, math.sqrt(square)), far
        total = total + energy(shape, masses[i])
        if target then err = math.max(err, math.abs(sim.getJointPosition(joints[i]) - target)) end
    end
    return gap, total, err
end
