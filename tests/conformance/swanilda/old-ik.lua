-- as: simulation
-- passes: 3
-- engine: bullet278
-- spec: kinematics 7; groups of inverse kinematics of V-REP that scripts create
-- tol: 1e-6
-- topic: kinematics
sim = require 'sim'

local joints, tip, target, group = {}, nil, nil, nil

local function refused(call, ...)
    local ok, text = pcall(call, ...)
    print(ok and 'accepted' or text:match('in .*') or text)
end

local function near(a, b)
    if #a ~= #b then return false end
    for i, x in ipairs(a) do if math.abs(x - b[i]) > 1e-6 then return false end end
    return true
end

local function positions() return {sim.getJointPosition(joints[1]), sim.getJointPosition(joints[2])} end

local function build()
    local parent = -1
    for i, x in ipairs{0, 0.5} do
        joints[i] = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
        sim.setJointMode(joints[i], sim.jointmode_ik, 0)
        sim.setJointInterval(joints[i], false, {-3, 6})
        sim.setObjectParent(joints[i], parent, true)
        sim.setObjectPose(joints[i], {x, 0, 0, 0, 0, 0, 1}, parent)
        parent = joints[i]
    end
    tip, target = sim.createDummy(0.01), sim.createDummy(0.01)
    sim.setObjectParent(tip, parent, true)
    sim.setObjectPose(tip, {0.5, 0, 0, 0, 0, 0, 1}, parent)
    sim.setJointPosition(joints[1], 0.3)
    sim.setJointPosition(joints[2], 0.6)
    sim.setLinkDummy(tip, target)
end

local function moveTarget(x, y)
    sim.setObjectPosition(target, {x, y, 0})
end

-- The numbers of one iteration: damped least squares, pseudo-inverse, Jacobian transpose.
local function solvers()
    moveTarget(0.788473229 + 0.01, 0.539423558 - 0.02)
    local known = {
        [sim.ik_damped_least_squares_method] = {0.272241117, 0.609748405},
        [sim.ik_pseudo_inverse_method] = {0.266525938, 0.620570460},
        [sim.ik_jacobian_transpose_method] = {0.278836300, 0.589867266},
    }
    for method = 0, 2 do
        print('properties', simSetIkGroupProperties(group, method, 1, 0.1))
        local result, values = simCheckIkGroup(group, joints)
        print('check', method, result, near(values, known[method]), near(positions(), {0.3, 0.6}))
    end
    simSetIkGroupProperties(group, sim.ik_pseudo_inverse_method, 30, 0)
    print('element', simSetIkElementProperties(group, tip, 3, {1e-7, 0.01}, {1, 1}))
    local result, values = simCheckIkGroup(group, joints, {0, 0})
    print('precise', result, near(values, {0.267466831, 0.618549038}))
end

local function jacobian()
    print('of the last check', select('#', simGetIkGroupMatrix(group, 0)))
    print('computed', simComputeJacobian(group, 0))
    local matrix, size = simGetIkGroupMatrix(group, 0)
    print('size', size[1], size[2], #matrix)
    -- Columns from base to tip; rows x and y.
    print('values', near(matrix, {-0.539423558, -0.391663455, 0.788473229, 0.310804984}))
end

local function paths()
    local path = simGenerateIkPath(group, joints, 4)
    print('path', #path, near({path[1], path[2]}, {0.3, 0.6}), near({path[7], path[8]}, {0.267466831, 0.618549038}))
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    local hand = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.02, 0.02, 0.02})
    sim.setObjectParent(hand, tip, false)
    sim.setObjectPosition(hand, {0, 0, 0}, tip)
    sim.setObjectPosition(box, {0.8, 0.5, 0})
    print('blocked', simGenerateIkPath(group, joints, 4, {hand, box}))
    sim.setObjectPosition(box, {-1, -1, 0})
    print('free', #simGenerateIkPath(group, joints, 4, {hand, sim.handle_all}))
    -- Two postures reach the target; a box is where the elbow of one is.
    moveTarget(0.6, 0.3)
    local seen = {}
    for _ = 1, 20 do
        local config = simGetConfigForTipPose(group, joints, 0.65, 10)
        seen[config[2] > 0 and 'left' or 'right'] = true
    end
    print('both', seen.left, seen.right)
    local elbow = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.02, 0.02, 0.3})
    sim.setObjectParent(elbow, joints[2], false)
    sim.setObjectPosition(elbow, {0, 0, 0}, joints[2])
    local left = simGetConfigForTipPose(group, joints, 0.65, 10, nil, nil, nil, {-3, 0}, {6, 3})
    sim.setObjectPosition(box, {0.5 * math.cos(left[1]), 0.5 * math.sin(left[1]), 0})
    local right = true
    for _ = 1, 20 do
        right = right and simGetConfigForTipPose(group, joints, 0.65, 10, {1, 1, 1, 0.1}, {elbow, box})[2] < 0
    end
    print('limited', left[2] > 0, 'right only', right, near(positions(), {0.3, 0.6}))
    moveTarget(3, 0)
    print('out of reach', simGetConfigForTipPose(group, joints, 0.65, 5), simGenerateIkPath(group, joints, 4))
    print('check', (simCheckIkGroup(group, joints)))
end

local function errors()
    refused(simCheckIkGroup, 5, joints)
    refused(simGetConfigForTipPose, 5, joints, 0.65, 10)
    refused(simGenerateIkPath, 5, joints, 4)
    refused(simComputeJacobian, 5, 0)
    refused(simGetIkGroupMatrix, 5, 0)
    refused(simSetIkGroupProperties, 5, 0, 1, 0.1)
    refused(simSetIkGroupProperties, group, 9, 1, 0.1)
    refused(simSetIkGroupProperties, group, 0, 1, 0 / 0)
    refused(simSetIkElementProperties, group, target, 3)
    refused(simCreateIkElement, group, 0, {tip})
    refused(simCreateIkElement, group, 0, {joints[1], -1, -1, 7})
    refused(simCreateIkElement, group, 0, {tip, 77777, -1, 7})
    refused(simCheckIkGroup, group, {tip})
    refused(simCheckIkGroup, group, joints, {0})
    refused(simGenerateIkPath, group, joints, 1)
    refused(simGenerateIkPath, group, joints, 2, {77777, 77778})
    refused(simGetIkGroupMatrix, group, 7)
end

function sysCall_init()
    build()
    group = simCreateIkGroup(2)
    print('group', group, simGetIkGroupHandle('IK_Group') == group, simCreateIkElement(group, 0, {tip, -1, -1, 3}, {0.0005, 0.01, 1, 1}))
    solvers()
    jacobian()
    paths()
    errors()
    -- A group without target, and a disabled one.
    local other = simCreateIkGroup(1, {1, 5}, {0.2})
    simCreateIkElement(other, 0, {target, -1, -1, 7})
    print('disabled', (simCheckIkGroup(other, joints)), simComputeJacobian(other, 0))
    print('removed', simRemoveIkGroup(other))
    sim.setBoolParam(sim.boolparam_ik_handling_enabled, false)
    moveTarget(0.7, 0.6)
end

local step = 0
function sysCall_sensing()
    step = step + 1
    local a, b = sim.getObjectPosition(tip), sim.getObjectPosition(target)
    print('step', step, math.abs(a[1] - b[1]) < 1e-6 and math.abs(a[2] - b[2]) < 1e-6)
    sim.setBoolParam(sim.boolparam_ik_handling_enabled, true)
end
