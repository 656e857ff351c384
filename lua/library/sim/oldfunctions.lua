--[[
Functions that 4.10 loads together when one of them is first called: their deprecation is logged once for all of them.

The steps of a blocking move are in swanilda/oldmotion.lua.
]]

local sim = ...
local M = {warnsOnceForAll = true}

local function check(types, ...) return require('checkargs.check').checkargsEx({level = 0}, types, ...) end

---------------------------------------------------------------- bits

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

--- Bitwise and, as sim.boolAnd32.
-- @api int result = sim.boolAnd16(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits set in both
function M.boolAnd16(a, b) return integer(a) & integer(b) end

--- Bitwise or, as sim.boolOr32.
-- @api int result = sim.boolOr16(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits set in one of them
function M.boolOr16(a, b) return integer(a) | integer(b) end

--- Bitwise exclusive or, as sim.boolXor32.
-- @api int result = sim.boolXor16(int a, int b)
-- @param a number
-- @param b number
-- @return result the bits that differ
function M.boolXor16(a, b) return integer(a) ~ integer(b) end

---------------------------------------------------------------- names

--- Names an object after another one: the old name, with the suffix and the first free number.
-- @api sim.setSimilarName(int handle, string original, string suffix)
-- @param handle the object
-- @param original name of the other; its `#` and number are kept
-- @param suffix appended to the name
function M.setSimilarName(handle, original, suffix)
    local base, number = original:match('^([^#]*)(#?%d*)$')
    local function isTaken(name)
        local taken = sim._getObjectHandle(name, {noError = true}, -1)
        return taken ~= -1 and taken ~= handle
    end
    local name, counter = base .. suffix .. number, 0
    while isTaken(name) do
        name, counter = base .. suffix .. counter .. number, counter + 1
    end
    sim.setObjectName(handle, name)
end

---------------------------------------------------------------- dialogs

local DIALOG_ARGS = {{type = 'string'}, {type = 'string'}, {type = 'int'}, {type = 'bool'}}

--- A message in a window. There are no windows.
-- @api int handle = sim.displayDialog(string title, string text, int style, bool modal, ...)
-- @param title of the window
-- @param text in it
-- @param style sim.dlgstyle_*
-- @param modal whether to wait
-- @return handle -1
function M.displayDialog(title, text, style, modal, ...)
    check(DIALOG_ARGS, title, text, style, modal)
    return -1
end

--- Closes a window of sim.displayDialog.
-- @api sim.endDialog(int handle)
-- @param handle from sim.displayDialog
function M.endDialog(handle) end

--- The user's choice; there is none.
-- @api int result = sim.getDialogResult(int handle)
-- @param handle from sim.displayDialog
-- @return result -1
function M.getDialogResult(handle) return -1 end

--- The user's input; there is none.
-- @api string input = sim.getDialogInput(int handle)
-- @param handle from sim.displayDialog
-- @return input empty
function M.getDialogInput(handle) return '' end

---------------------------------------------------------------- moves along jerk-limited trajectories

local HALF_TURN <const> = math.pi

-- The target of a cyclic joint, in the given turn of a direction: 2 is the second one with rising angles.
local function inTurn(position, target, direction)
    local turn = 2 * HALF_TURN
    if direction > 0 then return position + (target - position) % turn + (direction - 1) * turn end
    return position - (position - target) % turn + (direction + 1) * turn
end

local function checkSizes(n, ...)
    for i = 1, select('#', ...) do
        local list = select(i, ...)
        if list ~= nil and (type(list) ~= 'table' or #list < n) then error('Bad table size.', 3) end
    end
end

--- Moves joints to positions, blocking.
-- @api int result, float[] newPos, float[] newVel, float[] newAccel, float timeLeft = sim.rmlMoveToJointPositions(int[] joints, int flags, float[] currentVel, float[] currentAccel, float[] maxVel, float[] maxAccel, float[] maxJerk, float[] targetPos, float[] targetVel = nil, float[] direction = nil)
-- @param joints handles
-- @param flags as in sim.ruckigPos
-- @param currentVel nil: at rest
-- @param currentAccel nil: zero
-- @param maxVel limits
-- @param maxAccel limits
-- @param maxJerk limits
-- @param targetPos one per joint
-- @param targetVel nil: at rest
-- @param direction of cyclic joints: 1 rising within a turn, -1 falling, 2 and -2 a turn more; 0: as targetPos is
-- @return result 1
-- @return newPos where the joints are now
-- @return newVel their velocities
-- @return newAccel their accelerations
-- @return timeLeft unused part of the last step
function M.rmlMoveToJointPositions(joints, flags, vel, accel, maxVel, maxAccel, maxJerk, targetPos, targetVel, direction)
    M.hasWarned = true
    checkSizes(#joints, vel, accel, maxVel, maxAccel, maxJerk, targetPos, targetVel, direction)
    local targets = table.move(targetPos, 1, #joints, 1, {})
    for i = 1, direction and #joints or 0 do
        local turns = math.floor(direction[i])
        if turns ~= 0 and sim.getJointInterval(joints[i]) then
            targets[i] = inTurn(sim.getJointPosition(joints[i]), targets[i], turns)
        end
    end
    local data = sim.moveToConfig{
        joints = joints, flags = flags, vel = vel, accel = accel, maxVel = maxVel, maxAccel = maxAccel, maxJerk = maxJerk,
        targetPos = targets, targetVel = targetVel,
    }
    return 1, data.pos, data.vel, data.accel, data.timeLeft
end

--- Moves an object to a pose, blocking.
-- @api int result, float[3] newPos, float[4] newQuaternion, float[4] newVel, float[4] newAccel, float timeLeft = sim.rmlMoveToPosition(int object, int relativeTo, int flags, float[4] currentVel, float[4] currentAccel, float[4] maxVel, float[4] maxAccel, float[4] maxJerk, float[3] targetPosition, float[4] targetQuaternion, float[4] targetVel)
-- @param object handle
-- @param relativeTo frame of start and target: sim.handle_world, sim.handle_parent or a handle
-- @param flags as in sim.ruckigPos
-- @param currentVel ignored
-- @param currentAccel ignored
-- @param maxVel x, y, z and angle
-- @param maxAccel x, y, z and angle
-- @param maxJerk x, y, z and angle
-- @param targetPosition nil: unchanged
-- @param targetQuaternion nil: unchanged
-- @param targetVel ignored
-- @return result 1
-- @return newPos of the object
-- @return newQuaternion of the object
-- @return newVel zeros
-- @return newAccel zeros
-- @return timeLeft unused part of the last step
function M.rmlMoveToPosition(object, relativeTo, flags, _, _, maxVel, maxAccel, maxJerk, position, quaternion)
    M.hasWarned = true
    checkSizes(4, maxVel, maxAccel, maxJerk, quaternion)
    local start = sim.getObjectPose(object, relativeTo)
    local target = table.move(start, 1, 7, 1, {})
    if position then table.move(position, 1, 3, 1, target) end
    if quaternion then table.move(quaternion, 1, 4, 4, target) end
    local data = sim.moveToPose{
        pose = start, targetPose = target, flags = flags, maxVel = maxVel, maxAccel = maxAccel, maxJerk = maxJerk,
        callback = function(state) sim.setObjectPose(object, state.pose, relativeTo) end,
    }
    local pose = data.pose
    return 1, {pose[1], pose[2], pose[3]}, {pose[4], pose[5], pose[6], pose[7]}, {0, 0, 0, 0}, {0, 0, 0, 0}, data.timeLeft
end

---------------------------------------------------------------- moves of V-REP

--- Moves joints to positions, blocking.
-- @api float timeLeft = sim.moveToJointPositions(int[] joints, float[] targets, any velocity, any acceleration = nil, float angleCoefficient = 1.0)
-- @param joints handles; spherical joints and what is no joint is left out
-- @param targets one per joint
-- @param velocity a number: all arrive together; a table: each for itself
-- @param acceleration a number or a table; nil or 0: none is needed
-- @param angleCoefficient metres per radian
-- @return timeLeft unused part of the last step, seconds
function M.moveToJointPositions(joints, targets, velocity, acceleration, angleCoefficient)
    M.hasWarned = true
    return require('swanilda.oldmotion').joints(joints, targets, velocity, acceleration, angleCoefficient or 1.0)
end

--- Moves an object to a position and orientation, blocking.
-- @api float timeLeft = sim.moveToPosition(int object, int relativeTo, float[3] position, float[3] angles, float velocity, float acceleration = nil, float[2] distance = nil)
-- @param object handle
-- @param relativeTo frame of the target, which may move: sim.handle_world, sim.handle_parent or a handle
-- @param position nil: unchanged
-- @param angles Euler angles; nil: unchanged
-- @param velocity m/s
-- @param acceleration nil or 0: none is needed
-- @param distance sim.distcalcmethod_* and metres per radian
-- @return timeLeft unused part of the last step, seconds
function M.moveToPosition(object, relativeTo, position, angles, velocity, acceleration, distance)
    M.hasWarned = true
    return require('swanilda.oldmotion').pose(object, relativeTo, position, angles, velocity, acceleration, distance)
end

--- Moves an object to another one, which may move, blocking.
-- @api float timeLeft = sim.moveToObject(int object, int target, int what, float relativePosition, float velocity, float acceleration = nil)
-- @param object handle
-- @param target handle of the other
-- @param what 1 position, 2 orientation
-- @param relativePosition place on a path of V-REP, from 0 to 1; nil: the target itself
-- @param velocity 1/s: the way counts as 1
-- @param acceleration 1/s^2; nil or 0: none is needed
-- @return timeLeft unused part of the last step, seconds
function M.moveToObject(object, target, what, relativePosition, velocity, acceleration)
    M.hasWarned = true
    return require('swanilda.oldmotion').object(object, target, what, relativePosition, velocity, acceleration)
end

--- Moves an object along a path of V-REP, blocking. The position of the path itself stays.
-- @api float timeLeft = sim.followPath(int object, int path, int what, float start, float velocity, float acceleration = nil)
-- @param object handle
-- @param path handle
-- @param what 1 position, 2 orientation
-- @param start place on the path, from 0 to 1
-- @param velocity m/s; negative: towards the start of the path
-- @param acceleration nil or 0: none is needed
-- @return timeLeft a whole step, seconds; 0 on a path without length
function M.followPath(object, path, what, start, velocity, acceleration)
    M.hasWarned = true
    return require('swanilda.oldmotion').path(object, path, what, start, velocity, acceleration)
end

return M
