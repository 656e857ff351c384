-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: kinematics 5; postures, paths, overlays
-- tol: 1e-5
-- topic: kinematics
sim = require 'sim'
local simIK = require 'simIK'

local function refused(what, f, ...)
    local done, message = pcall(f, ...)
    print(what, done and 'no error' or (tostring(message):gsub('\nstack traceback.*', ''):gsub('^.-: in ', 'in ')))
end

local env = simIK.createEnvironment()
local joints = {}
local parent = -1
for i = 1, 3 do
    joints[i] = simIK.createJoint(env, simIK.jointtype_revolute)
    simIK.setJointInterval(env, joints[i], false, {-3, 6})
    simIK.setObjectParent(env, joints[i], parent)
    simIK.setObjectPose(env, joints[i], {i > 1 and 0.4 or 0, 0, 0, 0, 0, 0, 1}, parent)
    parent = joints[i]
end
local tip, target = simIK.createDummy(env), simIK.createDummy(env)
simIK.setObjectParent(env, tip, parent)
simIK.setObjectPose(env, tip, {0.2, 0, 0, 0, 0, 0, 1}, parent)
simIK.setTargetDummy(env, tip, target)
simIK.setConfig(env, joints, {0.2, 0.7, -0.3})
simIK.setObjectPose(env, target, simIK.getObjectPose(env, tip))
simIK.setConfig(env, joints, {0.6, 0.3, -0.1})
local group = simIK.createGroup(env)
local element = simIK.addElement(env, group, tip)
simIK.setElementConstraints(env, group, element, simIK.constraint_x | simIK.constraint_y | simIK.constraint_gamma)
simIK.setElementPrecision(env, group, element, {1e-6, 1e-6})
simIK.setGroupCalculation(env, group, simIK.method_damped_least_squares, 0.01, 50)

-- The plane arm has two postures: elbow left and elbow right.
local all = simIK.findConfigs(env, group, joints, {findMultiple = true})
print(#all)
for _, config in ipairs(all) do print(config) end
print('restored', simIK.getConfig(env, joints))
local again = simIK.findConfigs(env, group, joints, {findMultiple = true, maxTime = 0.05})
print(#again)
print('one', #simIK.findConfigs(env, group, joints), simIK.findConfig(env, group, joints))
local asked = 0
local function rejects(config, aux) asked = asked + 1 return config[2] < 0 and aux == 'aux' end
print('accepted', simIK.findConfigs(env, group, joints, {cb = rejects, auxData = 'aux'}), asked > 1)
print('known', #simIK.findConfigs(env, group, joints, {findMultiple = true}, {{1, 1, 1}}))
print('limited', simIK.getConfigForTipPose(env, group, joints, 0.1, 0.5, nil, nil, nil, {}, {-3, -3, -3}, {6, 3, 6}))
simIK.setObjectPose(env, target, {5, 0, 0, 0, 0, 0, 1})
print('none', #simIK.findConfigs(env, group, joints, {maxTime = 0.02}), simIK.findConfig(env, group, joints, 0.1, 0.02))
print('none on the way', #simIK.generatePath(env, group, joints, tip, 5))
simIK.setObjectPose(env, target, {0.7, 0.5, 0, 0, 0, math.sin(0.3), math.cos(0.3)})
local path = simIK.generatePath(env, group, joints, tip, 4)
print('path', #path, simIK.getConfig(env, joints))
simIK.setConfig(env, joints, table.move(path, 10, 12, 1, {}))
print(simIK.getObjectPose(env, tip))
print('refused', #simIK.generatePath(env, group, joints, tip, 4, function(config) return false end))

local turning = simIK.createJoint(env, simIK.jointtype_revolute)
simIK.setJointInterval(env, turning, false, {-7, 14})
simIK.setJointPosition(env, turning, 1)
print(simIK.getAlternateConfigs(env, {turning, joints[1]}))
print(simIK.getAlternateConfigs(env, {turning}, {-1}, {9}))

-- A path object along a line.
local line = sim.createPath({0.4, 0.5, 0, 0, 0, 0, 1, 0.6, 0.5, 0, 0, 0, 0, 1}, 0, 20, 0)
simIK.setElementConstraints(env, group, element, simIK.constraint_x | simIK.constraint_y)
local frame = simIK.createDummy(env)
local configs = simIK.solvePath(env, group, target, joints, {}, frame, line, {}, {delta = 0.02})
print('configs', #configs, #configs[1])
local copy = simIK.duplicateEnvironment(env)
local largest = 0
for i, config in ipairs(configs) do
    simIK.setConfig(copy, joints, config)
    local pose = simIK.getObjectPose(copy, tip)
    largest = math.max(largest, math.abs(pose[2] - 0.5), math.abs(pose[1] - 0.4 - 0.2 * (i - 1) / (#configs - 1)))
end
print('on the line', largest < 1e-5)
sim.setObjectPose(line, {5, 0, 0, 0, 0, 0, 1})
simIK.setObjectPose(env, frame, {5, 0, 0, 0, 0, 0, 1})
refused('too far', simIK.solvePath, env, group, target, joints, {}, frame, line)
print(simIK.solvePath(env, group, target, joints, {}, frame, line, {}, {errorCallback = function(text) print('told', text) end}))

local overlay = simIK.createDebugOverlay(env, tip)
simIK.eraseDebugOverlay(overlay)
refused('erased', simIK.eraseDebugOverlay, overlay)
simIK.debugGroupIfNeeded(env, group, 1)
simIK.eraseEnvironment(env)
refused('no callback', simIK.findConfigs, copy, group, joints, {cb = 'nobody'})
refused('no target', simIK.generatePath, copy, group, joints, frame, 3)
refused('wrong', simIK.findConfigs, copy, group, 5)
