--[[
sim.moveToPose: a pose, an object or the tip of a robot along a jerk-limited trajectory.

Does not plan a trajectory itself (sim.ruckigPos does), nor solve inverse kinematics (module simIK does).
]]

local sim = ...
local M = {}
local motion = require 'swanilda.trajectory'
local quaternion = require 'swanilda.quaternion'

local ARRIVED <const>, ABORTED <const> = 1, 2
local MIN_ANGLE <const> = 1e-5 * math.pi -- below, the angle between the poses has no axis worth following
local MIN_DISTANCE <const> = 1e-6

local function orientation(pose) return table.move(pose, 4, 7, 1, {}) end

---------------------------------------------------------------- inverse kinematics

local function passiveJoints(env, simToIk, used)
    local simIK = require 'simIK'
    local wanted = {}
    for _, joint in ipairs(used) do wanted[joint] = true end
    for simHandle, ikHandle in pairs(simToIk) do
        local isJoint = sim.isHandle(simHandle) and sim.getObjectType(simHandle) == sim.sceneobject_joint
        if isJoint and not wanted[simHandle] then simIK.setJointMode(env, ikHandle, simIK.jointmode_passive) end
    end
end

local function startIk(data, level)
    local ik = data.ik
    if type(ik) ~= 'table' then error("invalid 'ik' field.", level) end
    if not (math.tointeger(ik.tip) and math.tointeger(ik.target)) then
        error("missing or invalid 'tip' or 'target' field in 'ik'.", level)
    end
    local simIK = require 'simIK'
    sim.setObjectPose(ik.target, sim.getObjectPose(ik.tip))
    local env = simIK.createEnvironment()
    local group = simIK.createGroup(env)
    ik.env, ik.group = env, group
    local method = ik.method or simIK.method_damped_least_squares
    simIK.setGroupCalculation(env, group, method, ik.damping or 0.02, ik.iterations or 20)
    local constraints = ik.constraints or simIK.constraint_pose
    local element, simToIk = simIK.addElementFromScene(env, group, ik.base or -1, ik.tip, ik.target, constraints)
    simIK.setElementPrecision(env, group, element, ik.precision or {0.001, 0.5 * math.pi / 180})
    if ik.joints then passiveJoints(env, simToIk, ik.joints) end
end

local function solveIk(data)
    local ik = data.ik
    sim.setObjectPose(ik.target, data.pose)
    local options = {syncWorlds = true, allowError = ik.allowError}
    local _, flags = require('simIK').handleGroup(ik.env, ik.group, options)
    if flags & (ik.breakFlags or 0) ~= 0 then error('inverse kinematics failed, flags ' .. flags, 0) end
end

---------------------------------------------------------------- init, step, cleanup

local function asPose(value)
    if motion.isList(value, 12) then return sim.matrixToPose(value) end
    return motion.isList(value, 7) and value or nil
end

local function checkTarget(data, level)
    if not (data.pose or data.object or data.ik) then
        error("missing field: either 'pose', 'object' or 'ik' is required.", level)
    end
    data.targetPose = asPose(data.targetPose) or error("missing or invalid 'targetPose' field.", level)
    if data.metric and not motion.isList(data.metric, 4) then error("invalid 'metric' field.", level) end
end

local function isObject(value)
    local handle = math.tointeger(value)
    return handle and sim.isHandle(handle)
end

local function findStart(data, level)
    data.relObject = data.relObject or sim.handle_world
    if data.pose then
        data.mover = 'callback'
        data.pose = asPose(data.pose) or error("invalid 'pose' field.", level)
    elseif data.object then
        data.mover = 'object'
        if not isObject(data.object) then error("invalid 'object' field.", level) end
        if data.relObject ~= sim.handle_world and not isObject(data.relObject) then error("invalid 'relObject' field.", level) end
        data.pose = sim.getObjectPose(data.object, data.relObject)
    else
        data.mover = 'ik'
        startIk(data, level + 1)
        data.pose = sim.getObjectPose(data.ik.tip)
    end
    data.startPose, data.matrix = data.pose, sim.poseToMatrix(data.pose)
end

local function distance(data, metric)
    local sum = (data.angle * metric[4]) ^ 2
    for i = 1, 3 do sum = sum + ((data.targetPose[i] - data.startPose[i]) * metric[i]) ^ 2 end
    return math.sqrt(sum)
end

-- Positions and targets of the trajectory object: the distance, or x, y, z and the angle.
local function coordinates(data)
    data.angle = quaternion.angle(orientation(data.startPose), orientation(data.targetPose))
    if data.metric then
        data.distance = distance(data, data.metric)
        return {0.0}, {data.distance}
    end
    local from, to = table.move(data.startPose, 1, 3, 1, {}), table.move(data.targetPose, 1, 3, 1, {})
    from[4], to[4] = 0.0, data.angle
    return from, to
end

local function init(params, level)
    local data = motion.copyParams(params, level + 1)
    checkTarget(data, level + 1)
    local n = data.metric and 1 or 4
    motion.completeLimits(data, n, true, level + 1)
    motion.completeParams(data, n, level + 1)
    findStart(data, level + 1)
    local from, to = coordinates(data)
    if not data.metric or data.distance > MIN_DISTANCE then
        data.ruckigObj = motion.start(data, n, {from, data.vel, data.accel}, to, data.targetVel)
    end
    return data
end

local function poseAt(data, position)
    local pose, t = {}, nil
    if data.metric then
        t = position[1] / data.distance
        for i = 1, 3 do pose[i] = data.startPose[i] + (data.targetPose[i] - data.startPose[i]) * t end
    else
        t = data.angle > MIN_ANGLE and position[4] / data.angle or 0
        table.move(position, 1, 3, 1, pose)
    end
    local turned = quaternion.slerp(orientation(data.startPose), orientation(data.targetPose), t)
    return table.move(turned, 1, 4, 4, pose)
end

local function apply(data)
    if data.mover == 'ik' then solveIk(data) end
    if data.callback then return motion.functionOf(data.callback)(data) end
    if data.mover == 'object' then sim.setObjectPose(data.object, data.pose, data.relObject) end
end

local function step(data)
    local result = ARRIVED
    if data.ruckigObj then
        local state
        result, state = motion.advance(data)
        if result < 0 then return result, data end
        local n = data.metric and 1 or 4
        data.pose = poseAt(data, state)
        data.vel = table.move(state, n + 1, 2 * n, 1, {})
        data.accel = table.move(state, 2 * n + 1, 3 * n, 1, {})
    else
        data.pose = table.move(data.targetPose, 1, 7, 1, {})
    end
    data.matrix = sim.poseToMatrix(data.pose)
    if apply(data) then return ABORTED, data end
    return result, data
end

local function cleanup(data)
    motion.finish(data)
    data.startPose = nil
    if data.ik and data.ik.env then require('simIK').eraseEnvironment(data.ik.env) end
    if data.ik then data.ik.env = nil end
end

local function checkMotion(data, level)
    if type(data) ~= 'table' or not data.startPose then
        error('not a motion under way: sim.moveToPose_init begins one.', level)
    end
end

local FLOATS = {type = 'table', item_type = 'float'}
local LEGACY_ARGS = {
    {type = 'int'}, {type = 'table'}, FLOATS, FLOATS, FLOATS, {type = 'table'}, {type = 'any'},
    {type = 'any', default_nil = true}, {type = 'table', nullable = true}, {type = 'float', default = 0},
}

local function fromLegacyArgs(...)
    local flags, pose, maxVel, maxAccel, maxJerk, targetPose, callback, aux, metric, timeStep =
        require('checkargs.check').checkargsEx({level = 1}, LEGACY_ARGS, ...)
    local field = #pose == 12 and 'matrix' or 'pose'
    local params = {flags = flags, pose = pose, targetPose = targetPose, auxData = aux, metric = metric, timeStep = timeStep}
    motion.addOlder(params, metric and 1 or 4, {vel = maxVel, accel = maxAccel, jerk = maxJerk}, callback, field, 4)
    return params, field
end

--- Starts a motion that is advanced with sim.moveToPose_step.
-- @api map motionObject = sim.moveToPose_init(map params)
-- @param params as in sim.moveToPose
-- @return motionObject for the other two functions
function M.moveToPose_init(params)
    local data = init(params, 3)
    return data
end

--- Advances a motion by one time step.
-- @api int result, map motionObject = sim.moveToPose_step(map motionObject)
-- @param motionObject from sim.moveToPose_init
-- @return result 0 moving, 1 arrived, 2 stopped by the callback, negative: error
-- @return motionObject with the new pose, vel and accel
function M.moveToPose_step(motionObject)
    checkMotion(motionObject, 3)
    return step(motionObject)
end

--- Ends a motion started with sim.moveToPose_init.
-- @api sim.moveToPose_cleanup(map motionObject)
-- @param motionObject from sim.moveToPose_init
function M.moveToPose_cleanup(motionObject)
    if type(motionObject) == 'table' then cleanup(motionObject) end
end

--- Moves a pose, an object or the tip of a robot to a target pose, with limited velocity, acceleration and jerk.
-- Blocks in a thread. The older form takes flags, pose or matrix, maxVel, maxAccel, maxJerk, target, callback, auxData,
-- metric, timeStep and returns the last pose or matrix, and timeLeft.
-- @api map data = sim.moveToPose(map params)
-- @param params pose, object or ik; targetPose, maxVel, maxAccel, maxJerk, and more
-- @return data the params with the final pose, vel, accel and timeLeft
function M.moveToPose(params, ...)
    local shape
    if type(params) ~= 'table' then params, shape = fromLegacyArgs(params, ...) end
    local data = init(params, 3)
    local result = motion.run(data, step, cleanup)
    if result < 0 then error('sim.moveToPose_step returned error code ' .. result, 2) end
    if shape then return data[shape], data.timeLeft end
    return data
end

return M
