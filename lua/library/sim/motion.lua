--[[
sim.moveToConfig: joints, or plain numbers, along a jerk-limited trajectory.

Does not plan a trajectory itself (sim.ruckigPos does), nor move poses (pose.lua).
]]

local sim = ...
local M = {}
local motion = require 'swanilda.trajectory'

local ABORTED <const> = 2

local function positionsOf(joints)
    local positions = {}
    for i, joint in ipairs(joints) do positions[i] = sim.getJointPosition(joint) end
    return positions
end

local function isJoint(handle)
    handle = math.tointeger(handle)
    return handle and sim.isHandle(handle) and sim.getObjectType(handle) == sim.sceneobject_joint
end

local function checkJoints(joints, count)
    if type(joints) ~= 'table' or #joints ~= (count or math.max(1, #joints)) then return false end
    for _, joint in ipairs(joints) do
        if not isJoint(joint) then return false end
    end
    return true
end

local function checkStart(data, level)
    if data.joints == nil and data.pos == nil then
        error("missing field: either 'pos' or 'joints' is required.", level)
    end
    if data.pos and not motion.isList(data.pos, 1, true) then
        error("invalid 'pos' field.", level)
    end
    if data.joints ~= nil and not checkJoints(data.joints, data.pos and #data.pos) then
        error("invalid 'joints' field.", level)
    end
    data.pos = data.pos or positionsOf(data.joints)
    if not motion.isList(data.targetPos, #data.pos) then error("missing or invalid 'targetPos' field.", level) end
    if data.cyclicJoints ~= nil and type(data.cyclicJoints) ~= 'table' then error("invalid 'cyclicJoints' field.", level) end
end

local function unwrapTargets(data)
    for i = 1, data.cyclicJoints and #data.pos or 0 do
        if data.cyclicJoints[i] then
            local turns = (data.targetPos[i] - data.pos[i]) / (2 * math.pi)
            data.targetPos[i] = data.targetPos[i] - 2 * math.pi * math.floor(turns + 0.5)
        end
    end
end

local function init(params, level)
    local data = motion.copyParams(params, level + 1)
    checkStart(data, level + 1)
    local n = #data.pos
    motion.completeLimits(data, n, false, level + 1)
    motion.completeParams(data, n, level + 1)
    unwrapTargets(data)
    data.ruckigObj = motion.start(data, n, {data.pos, data.vel, data.accel}, data.targetPos, data.targetVel)
    return data
end

local function applyToJoints(data)
    for i, joint in ipairs(data.joints) do
        if sim.isDynamicallyEnabled(joint) then
            sim.setJointTargetPosition(joint, data.pos[i])
        else
            sim.setJointPosition(joint, data.pos[i])
        end
    end
end

local function step(data)
    local result, pva = motion.advance(data)
    if result < 0 then return result, data end
    local n = #data.pos
    data.pos = table.move(pva, 1, n, 1, {})
    data.vel = table.move(pva, n + 1, 2 * n, 1, {})
    data.accel = table.move(pva, 2 * n + 1, 3 * n, 1, {})
    if data.callback then
        if motion.functionOf(data.callback)(data) then return ABORTED, data end
    elseif data.joints then
        applyToJoints(data)
    end
    return result, data
end

local function checkMotion(data, level)
    if type(data) ~= 'table' or not data.ruckigObj then
        error('not a motion under way: sim.moveToConfig_init begins one.', level)
    end
end

local LEGACY_ARGS = {
    {type = 'int'}, {type = 'table', item_type = 'float'}, {type = 'table', item_type = 'float', nullable = true},
    {type = 'table', item_type = 'float', nullable = true}, {type = 'table', item_type = 'float'},
    {type = 'table', item_type = 'float'}, {type = 'table', item_type = 'float'}, {type = 'table', item_type = 'float'},
    {type = 'table', item_type = 'float', nullable = true}, {type = 'any'}, {type = 'any', default_nil = true},
    {type = 'table', item_type = 'bool', nullable = true}, {type = 'float', default = 0},
}

local function fromLegacyArgs(...)
    local flags, pos, vel, accel, maxVel, maxAccel, maxJerk, targetPos, targetVel, callback, aux, cyclic, timeStep =
        require('checkargs.check').checkargsEx({level = 1}, LEGACY_ARGS, ...)
    local n = #pos
    local params = {
        flags = flags, pos = pos, vel = vel, accel = accel, auxData = aux, cyclicJoints = cyclic, timeStep = timeStep,
        targetPos = table.move(targetPos, 1, n, 1, {}), targetVel = targetVel,
    }
    motion.addOlder(params, n, {vel = maxVel, accel = maxAccel, jerk = maxJerk}, callback, 'pos', 4)
    return params
end

--- Starts a motion that is advanced with sim.moveToConfig_step.
-- @api map motionObject = sim.moveToConfig_init(map params)
-- @param params as in sim.moveToConfig
-- @return motionObject for the other two functions
function M.moveToConfig_init(params)
    local data = init(params, 3)
    return data
end

--- Advances a motion by one time step.
-- @api int result, map motionObject = sim.moveToConfig_step(map motionObject)
-- @param motionObject from sim.moveToConfig_init
-- @return result 0 moving, 1 arrived, 2 stopped by the callback, negative: error
-- @return motionObject with the new pos, vel and accel
function M.moveToConfig_step(motionObject)
    checkMotion(motionObject, 3)
    return step(motionObject)
end

--- Ends a motion started with sim.moveToConfig_init.
-- @api sim.moveToConfig_cleanup(map motionObject)
-- @param motionObject from sim.moveToConfig_init
function M.moveToConfig_cleanup(motionObject)
    if type(motionObject) == 'table' then motion.finish(motionObject) end
end

--- Moves joints or a set of numbers to a target, with limited velocity, acceleration and jerk.
-- Blocks in a thread. The older form takes flags, pos, vel, accel, maxVel, maxAccel, maxJerk, targetPos, targetVel,
-- callback, auxData, cyclicJoints, timeStep and returns pos, vel, accel, timeLeft.
-- @api map data = sim.moveToConfig(map params)
-- @param params joints or pos, targetPos, maxVel, maxAccel, maxJerk, and more
-- @return data the params with the final pos, vel, accel and timeLeft
function M.moveToConfig(params, ...)
    local legacy = type(params) ~= 'table'
    if legacy then params = fromLegacyArgs(params, ...) end
    local data = init(params, 3)
    local result = motion.run(data, step, motion.finish)
    if result < 0 then error('sim.moveToConfig_step returned error code ' .. result, 2) end
    if legacy then return data.pos, data.vel, data.accel, data.timeLeft end
    return data
end

return M
