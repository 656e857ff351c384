--[[
sim.moveToConfig: joints, or plain numbers, along a jerk-limited trajectory.

Does not plan a trajectory itself (sim.ruckigPos does), nor move poses (pose.lua).
]]

local sim = ...
local M = {}
local motion = require 'trajectory'

local PHASE_SYNC_DEFAULT <const> = -1
local RUNNING <const>, ABORTED <const> = 0, 2

-- Deep copy, except of what the caller handed over to get it back: auxData and functions.
local function copyParams(params)
    local data = {}
    for key, value in pairs(params) do
        data[key] = key == 'auxData' and value or motion.copy(value)
    end
    return data
end

local function positionsOf(joints)
    local positions = {}
    for i, joint in ipairs(joints) do positions[i] = sim.getJointPosition(joint) end
    return positions
end

local function checkStart(data, level)
    if data.joints == nil and data.pos == nil then
        error("missing field: either 'pos' or 'joints' is required.", level)
    end
    if data.joints ~= nil and (type(data.joints) ~= 'table' or data.pos and #data.joints ~= #data.pos) then
        error("invalid 'joints' field.", level)
    end
    data.pos = data.pos or positionsOf(data.joints)
    if type(data.targetPos) ~= 'table' or #data.targetPos ~= #data.pos then
        error("missing or invalid 'targetPos' field.", level)
    end
end

local function unwrapTargets(data)
    for i, cyclic in ipairs(data.cyclicJoints or {}) do
        if cyclic then
            local turns = (data.targetPos[i] - data.pos[i]) / (2 * math.pi)
            data.targetPos[i] = data.targetPos[i] - 2 * math.pi * math.floor(turns + 0.5)
        end
    end
end

local function init(params, level)
    local data = copyParams(params)
    checkStart(data, level + 1)
    local n = #data.pos
    for _, field in ipairs{'vel', 'accel', 'targetVel'} do
        data[field] = data[field] or motion.fill(0.0, n)
        if type(data[field]) ~= 'table' or #data[field] < n then error("invalid '" .. field .. "' field.", level) end
    end
    motion.completeLimits(data, n, false, level + 1)
    unwrapTargets(data)
    data.flags = data.flags or PHASE_SYNC_DEFAULT
    data.timeLeft = 0
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

local function run(data)
    local stepping = sim.setStepping(true)
    local result
    repeat
        result = step(data)
        if result >= 0 then sim.step() end
    until result ~= RUNNING
    motion.finish(data)
    sim.setStepping(stepping)
    return result
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
        require('checkargs').checkargsEx({level = 1}, LEGACY_ARGS, ...)
    local n = #pos
    local params = {
        flags = flags, pos = pos, vel = vel, accel = accel, auxData = aux, cyclicJoints = cyclic, timeStep = timeStep,
        targetPos = table.move(targetPos, 1, n, 1, {}), targetVel = targetVel,
        maxJerk = table.move(maxJerk, 1, n, 1, {}),
    }
    params.maxVel, params.minVel = motion.splitLegacy(maxVel, n, flags, sim.ruckig_minvel)
    params.maxAccel, params.minAccel = motion.splitLegacy(maxAccel, n, flags, sim.ruckig_minaccel)
    params.callback = function(data)
        return motion.functionOf(callback)(data.pos, data.vel, data.accel, data.auxData)
    end
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
function M.moveToConfig_step(motionObject) return step(motionObject) end

--- Ends a motion started with sim.moveToConfig_init.
-- @api sim.moveToConfig_cleanup(map motionObject)
-- @param motionObject from sim.moveToConfig_init
function M.moveToConfig_cleanup(motionObject) motion.finish(motionObject) end

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
    local result = run(data)
    if result < 0 then error('sim.moveToConfig_step returned error code ' .. result, 2) end
    if legacy then return data.pos, data.vel, data.accel, data.timeLeft end
    return data
end

return M
