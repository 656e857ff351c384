-- topic: kinematics
-- as: sandbox
-- passes: 0
-- spec: kinematics 2
-- note: until 4.2 the frame came before the pose, the matrix, the position and orientation; both orders do the same
sim = require 'sim'
local simIK = require 'simIK'
local env = simIK.createEnvironment()
local frame, new, old = simIK.createDummy(env), simIK.createDummy(env), simIK.createDummy(env)
simIK.setObjectPose(env, frame, {1, 2, 3, 0, 0, 0, 1})
local function show(name) print(name, table.unpack(simIK.getObjectPose(env, new))) print(name, table.unpack(simIK.getObjectPose(env, old))) end
simIK.setObjectPose(env, new, {0.5, 0, 0, 0, 0, 0, 1}, frame)
simIK.setObjectPose(env, old, frame, {0.5, 0, 0, 0, 0, 0, 1})
show 'pose'
simIK.setObjectMatrix(env, new, {0, -1, 0, 0, 1, 0, 0, 0.25, 0, 0, 1, 0}, frame)
simIK.setObjectMatrix(env, old, frame, {0, -1, 0, 0, 1, 0, 0, 0.25, 0, 0, 1, 0})
show 'matrix'
simIK.setObjectTransformation(env, new, {0, 0, 1}, {1, 0, 0, 0}, frame)
simIK.setObjectTransformation(env, old, frame, {0, 0, 1}, {1, 0, 0, 0})
show 'transformation'
simIK.setObjectTransformation(env, old, -1, {0, 0, 1}, {0, 0, 0})
print('world', table.unpack(simIK.getObjectPose(env, old)))
print('two frames', (pcall(simIK.setObjectPose, env, old, frame, -1)), (pcall(simIK.setObjectTransformation, env, old, {0, 0, 1}, {0, 0, 0}, {1, 2, 3})))
