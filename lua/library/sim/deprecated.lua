--[[
Old functions of sim that scripts still use, based on the new ones.

Deprecation notices and plain aliases are native.
]]

local sim = ...
local M = {}

local function integer(value) return math.floor(value) end

--- Bitwise and.
-- @api int result = sim.boolAnd32(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits set in both
function M.boolAnd32(a, b) return integer(a) & integer(b) end

--- Bitwise or.
-- @api int result = sim.boolOr32(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits set in one of them
function M.boolOr32(a, b) return integer(a) | integer(b) end

--- Bitwise exclusive or.
-- @api int result = sim.boolXor32(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits that differ
function M.boolXor32(a, b) return integer(a) ~ integer(b) end

--- Bitwise and of the lower 16 bits.
-- @api int result = sim.boolAnd16(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits set in both
function M.boolAnd16(a, b) return integer(a) & integer(b) & 0xffff end

--- Bitwise or of the lower 16 bits.
-- @api int result = sim.boolOr16(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits set in one of them
function M.boolOr16(a, b) return (integer(a) | integer(b)) & 0xffff end

--- Bitwise exclusive or of the lower 16 bits.
-- @api int result = sim.boolXor16(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits that differ
function M.boolXor16(a, b) return (integer(a) ~ integer(b)) & 0xffff end

--- Copy of a table, tables inside included.
-- @api any[] copy = sim.copyTable(any[] original)
-- @param original table
-- @return copy shares nothing with the original
function M.copyTable(original)
    local copy = require('tablex').deepcopy(original)
    return copy
end

--- Sets how long a thread may run before it is interrupted.
-- @api sim.setThreadSwitchTiming(int milliseconds)
-- @param milliseconds whole
function M.setThreadSwitchTiming(milliseconds)
    sim.setAutoYieldDelay((milliseconds + 0.001) / 1000) -- the delay is cut to whole milliseconds
end

--- The time slice of a thread.
-- @api float value = sim.getThreadSwitchTiming()
-- @return value milliseconds times 1000, as in 4.10
function M.getThreadSwitchTiming() return sim.getAutoYieldDelay() * 1000 end

--- Whether the simulation runs in real time.
-- @api int result = sim.getIsRealTimeSimulation()
-- @return result 1 or 0
function M.getIsRealTimeSimulation() return sim.getBoolParam(sim.boolparam_realtime_simulation) and 1 or 0 end

--- Names an object after another one, with a suffix.
-- @api sim.setSimilarName(int handle, string original, string suffix)
-- @param handle the object
-- @param original name of the other
-- @param suffix appended unless there already
function M.setSimilarName(handle, original, suffix)
    local name = original:sub(-#suffix) == suffix and original or original .. suffix
    sim.setObjectAlias(handle, name)
end

---------------------------------------------------------------- Euler angles

local ANGLES = {{type = 'float'}, {type = 'float'}, {type = 'float'}}

--- From the angles of sim.getObjectOrientation to yaw, pitch and roll.
-- @api float yaw, float pitch, float roll = sim.alphaBetaGammaToYawPitchRoll(float alpha, float beta, float gamma)
-- @param alpha about x, first
-- @param beta about the new y
-- @param gamma about the new z
-- @return yaw about z, first
-- @return pitch about the new y
-- @return roll about the new x
function M.alphaBetaGammaToYawPitchRoll(...)
    local alpha, beta, gamma = require('checkargs')(ANGLES, ...)
    local sa, ca, sb, cb = math.sin(alpha), math.cos(alpha), math.sin(beta), math.cos(beta)
    local sg, cg = math.sin(gamma), math.cos(gamma)
    local r31 = sa * sg - ca * sb * cg
    if math.abs(r31) > 0.999999 then -- roll and yaw turn about the same axis: all of it is called roll
        return 0, r31 < 0 and math.pi / 2 or -math.pi / 2, math.atan(sa * cb, ca * cg - sa * sb * sg)
    end
    local yaw = math.atan(ca * sg + sa * sb * cg, cb * cg)
    return yaw, math.asin(-r31), math.atan(sa * cg + ca * sb * sg, ca * cb)
end

--- From yaw, pitch and roll to the angles of sim.getObjectOrientation.
-- @api float alpha, float beta, float gamma = sim.yawPitchRollToAlphaBetaGamma(float yaw, float pitch, float roll)
-- @param yaw about z, first
-- @param pitch about the new y
-- @param roll about the new x
-- @return alpha about x, first
-- @return beta about the new y
-- @return gamma about the new z
function M.yawPitchRollToAlphaBetaGamma(...)
    local yaw, pitch, roll = require('checkargs')(ANGLES, ...)
    local sy, cy, sp, cp = math.sin(yaw), math.cos(yaw), math.sin(pitch), math.cos(pitch)
    local sr, cr = math.sin(roll), math.cos(roll)
    local r13 = sy * sr + cy * sp * cr
    if math.abs(r13) > 0.999999 then -- alpha and gamma turn about the same axis: all of it is called alpha
        return math.atan(cp * sr, cy * cr + sy * sp * sr), r13 > 0 and math.pi / 2 or -math.pi / 2, 0.0
    end
    local alpha = math.atan(cy * sr - sy * sp * cr, cp * cr)
    return alpha, math.asin(r13), math.atan(sy * cr - cy * sp * sr, cy * cp)
end

---------------------------------------------------------------- named parameters and settings

local function boolOf(text)
    if text == nil then return nil end
    text = tostring(text):lower()
    return text == 'true' or text == '1' or text == 'on' or text == 'yes'
end

local function setting(key)
    return sim.getStringProperty(sim.handle_app, 'namedParam.settings.' .. key, {noError = true})
end

--- Named parameter as a boolean.
-- @api bool value = sim.getNamedBoolParam(string name)
-- @param name of the parameter
-- @return value nil if there is none
function M.getNamedBoolParam(name) return boolOf(sim.getNamedStringParam(name)) end

--- Named parameter as a float.
-- @api float value = sim.getNamedFloatParam(string name)
-- @param name of the parameter
-- @return value nil if there is none
function M.getNamedFloatParam(name) return tonumber(sim.getNamedStringParam(name)) end

--- Named parameter as an integer.
-- @api int value = sim.getNamedInt32Param(string name)
-- @param name of the parameter
-- @return value nil if there is none
function M.getNamedInt32Param(name) return math.tointeger(tonumber(sim.getNamedStringParam(name))) end

--- Sets a named parameter from a boolean.
-- @api sim.setNamedBoolParam(string name, bool value)
-- @param name of the parameter
-- @param value stored as text
function M.setNamedBoolParam(name, value) sim.setNamedStringParam(name, value and 'true' or 'false') end

--- Sets a named parameter from a float.
-- @api sim.setNamedFloatParam(string name, float value)
-- @param name of the parameter
-- @param value stored as text
function M.setNamedFloatParam(name, value) sim.setNamedStringParam(name, tostring(value)) end

--- Sets a named parameter from an integer.
-- @api sim.setNamedInt32Param(string name, int value)
-- @param name of the parameter
-- @param value stored as text
function M.setNamedInt32Param(name, value) sim.setNamedStringParam(name, tostring(value)) end

--- User setting as a boolean.
-- @api bool value = sim.getSettingBool(string key)
-- @param key of the setting
-- @return value nil if there is none
function M.getSettingBool(key) return boolOf(setting(key)) end

--- User setting as a float.
-- @api float value = sim.getSettingFloat(string key)
-- @param key of the setting
-- @return value nil if there is none
function M.getSettingFloat(key) return tonumber(setting(key)) end

--- User setting as an integer.
-- @api int value = sim.getSettingInt32(string key)
-- @param key of the setting
-- @return value nil if there is none
function M.getSettingInt32(key) return math.tointeger(tonumber(setting(key))) end

--- User setting as text.
-- @api string value = sim.getSettingString(string key)
-- @param key of the setting
-- @return value nil if there is none
function M.getSettingString(key) return setting(key) end

---------------------------------------------------------------- parameters of objects, with a result before the value

--- A floating-point parameter of an object.
-- @api int result, float parameter = sim.getObjectFloatParameter(int objectHandle, int parameterID)
-- @param objectHandle the object
-- @param parameterID as in sim.getObjectFloatParam
-- @return result 1, or 0 when there is no value
-- @return parameter the value
function M.getObjectFloatParameter(objectHandle, parameterID)
    local value = sim.getObjectFloatParam(objectHandle, parameterID)
    if value == nil then return 0 end
    return 1, value
end

--- An integer parameter of an object.
-- @api int result, int parameter = sim.getObjectInt32Parameter(int objectHandle, int parameterID)
-- @param objectHandle the object
-- @param parameterID as in sim.getObjectInt32Param
-- @return result 1, or 0 when there is no value
-- @return parameter the value
function M.getObjectInt32Parameter(objectHandle, parameterID)
    local value = sim.getObjectInt32Param(objectHandle, parameterID)
    if value == nil then return 0 end
    return 1, value
end

---------------------------------------------------------------- moves of V-REP

--- Moves joints to positions, blocking.
-- @api int result, float[] newPos, float[] newVel, float[] newAccel, float timeLeft = sim.rmlMoveToJointPositions(int[] joints, int flags, float[] currentVel, float[] currentAccel, float[] maxVel, float[] maxAccel, float[] maxJerk, float[] targetPos, float[] targetVel)
-- @param joints handles
-- @param flags as in sim.ruckigPos
-- @param currentVel nil: at rest
-- @param currentAccel nil: zero
-- @param maxVel limits
-- @param maxAccel limits
-- @param maxJerk limits
-- @param targetPos one per joint
-- @param targetVel nil: at rest
-- @return result 0: done
-- @return newPos where the joints are now
-- @return newVel their velocities
-- @return newAccel their accelerations
-- @return timeLeft unused part of the last step
function M.rmlMoveToJointPositions(joints, flags, vel, accel, maxVel, maxAccel, maxJerk, targetPos, targetVel)
    local data = sim.moveToConfig{
        joints = joints, flags = flags, vel = vel, accel = accel, maxVel = maxVel, maxAccel = maxAccel, maxJerk = maxJerk,
        targetPos = targetPos, targetVel = targetVel,
    }
    return 0, data.pos, data.vel, data.accel, data.timeLeft
end

--- Moves an object to a pose, blocking.
-- @api int result, float[3] newPos, float[4] newQuaternion, float[4] newVel, float[4] newAccel, float timeLeft = sim.rmlMoveToPosition(int object, int relativeTo, int flags, float[4] currentVel, float[4] currentAccel, float[4] maxVel, float[4] maxAccel, float[4] maxJerk, float[3] targetPosition, float[4] targetQuaternion, float[4] targetVel)
-- @param object handle
-- @param relativeTo frame of the target, -1 for the world
-- @param flags as in sim.ruckigPos
-- @param currentVel nil: at rest
-- @param currentAccel nil: zero
-- @param maxVel x, y, z and angle
-- @param maxAccel x, y, z and angle
-- @param maxJerk x, y, z and angle
-- @param targetPosition nil: unchanged
-- @param targetQuaternion nil: unchanged
-- @param targetVel nil: at rest
-- @return result 0: done
-- @return newPos of the object
-- @return newQuaternion of the object
-- @return newVel x, y, z and angle
-- @return newAccel x, y, z and angle
-- @return timeLeft unused part of the last step
function M.rmlMoveToPosition(object, relativeTo, flags, vel, accel, maxVel, maxAccel, maxJerk, position, quaternion, targetVel)
    local target = sim.getObjectPose(object, relativeTo)
    if position then table.move(position, 1, 3, 1, target) end
    if quaternion then table.move(quaternion, 1, 4, 4, target) end
    local data = sim.moveToPose{
        object = object, relObject = relativeTo, targetPose = target, flags = flags, vel = vel, accel = accel,
        maxVel = maxVel, maxAccel = maxAccel, maxJerk = maxJerk, targetVel = targetVel,
    }
    local pose = data.pose
    return 0, {pose[1], pose[2], pose[3]}, {pose[4], pose[5], pose[6], pose[7]}, data.vel, data.accel, data.timeLeft
end

local HARD <const> = 1000000.0 -- stands for: no limit on acceleration or jerk

--- Moves joints to positions at one velocity, blocking.
-- @api sim.moveToJointPositions(int[] joints, float[] targets, float velocity, float acceleration = nil)
-- @param joints handles
-- @param targets one per joint
-- @param velocity limit
-- @param acceleration limit; nil: none
function M.moveToJointPositions(joints, targets, velocity, acceleration)
    local maxVel = require('tablex').rep(velocity, #joints)
    sim.moveToConfig{joints = joints, targetPos = targets, maxVel = maxVel, maxAccel = acceleration or HARD, maxJerk = HARD}
end

--- Moves an object to a position and orientation at one velocity, blocking.
-- @api sim.moveToPosition(int object, int relativeTo, float[3] position, float[3] angles, float velocity, float acceleration = nil)
-- @param object handle
-- @param relativeTo frame of the target, -1 for the world
-- @param position nil: unchanged
-- @param angles nil: unchanged
-- @param velocity limit
-- @param acceleration limit; nil: none
function M.moveToPosition(object, relativeTo, position, angles, velocity, acceleration)
    position = position or sim.getObjectPosition(object, relativeTo)
    angles = angles or sim.getObjectOrientation(object, relativeTo)
    sim.moveToPose{
        object = object, relObject = relativeTo, targetPose = sim.buildPose(position, angles),
        maxVel = velocity, maxAccel = acceleration or HARD, maxJerk = HARD, metric = {1, 1, 1, 0.1},
    }
end

--- Moves an object to the pose of another one at one velocity, blocking.
-- @api sim.moveToObject(int object, int target, int options, float distance, float velocity, float acceleration = nil)
-- @param object handle
-- @param target handle of the other
-- @param options ignored: position and orientation are both followed
-- @param distance ignored: position on a path of V-REP
-- @param velocity limit
-- @param acceleration limit; nil: none
function M.moveToObject(object, target, _, _, velocity, acceleration)
    sim.moveToPose{
        object = object, targetPose = sim.getObjectPose(target), metric = {1, 1, 1, 0.1},
        maxVel = velocity, maxAccel = acceleration or HARD, maxJerk = HARD,
    }
end

return M
