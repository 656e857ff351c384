--[[
The blocking moves of V-REP: one number moves from 0 to a distance, at one velocity or with a trapezoid of velocities (spec: vrep-era 4).

Moves along jerk-limited trajectories are in trajectory.lua.
]]

local sim = _quietRequire 'sim'
local M = {}

local TOLERANCE <const> = 1e-5 -- distance to the end of a path at which it is reached
local POSITION <const>, ORIENTATION <const> = 1, 2
local USUAL_DISTANCE <const> = {5, 0.1 / (math.pi / 2)} -- sim.distcalcmethod_dl_if_nonzero, metres per radian

local function checkNumber(value, name, level)
    if type(value) ~= 'number' or value ~= value then error(name .. ' is not a number.', level + 1) end
end

-- A motion from 0 to a distance: where it is at a time, and how long it takes.
local function motion(distance, velocity, acceleration)
    checkNumber(velocity, 'velocity', 4)
    acceleration = math.abs(acceleration or 0)
    velocity = math.abs(velocity)
    if velocity == 0 and distance > 0 then error('the velocity is 0: the target is never reached.', 3) end
    if distance == 0 then return {duration = 0, at = function() return 0 end} end
    if acceleration == 0 then
        return {duration = distance / velocity, at = function(t) return math.min(distance, velocity * t) end}
    end
    velocity = math.min(velocity, math.sqrt(distance * acceleration))
    local ramp = velocity / acceleration
    local duration = distance / velocity + ramp
    return {duration = duration, at = function(t)
        if t >= duration then return distance end
        if t < ramp then return acceleration * t * t / 2 end
        local left = duration - t
        if left < ramp then return distance - acceleration * left * left / 2 end
        return velocity * (t - ramp / 2)
    end}
end

-- Calls advance(dt) in each step until it returns true, which is in the last one.
local function run(advance)
    local stepping = sim.setStepping(true)
    local ending <close> = setmetatable({}, {__close = function() sim.setStepping(stepping) end})
    repeat
        local isDone = advance(sim.getSimulationTimeStep())
        sim.step()
    until isDone
end

-- Runs a motion with place(s), s from 0 to the distance; returns what is left of the last step. place may end it by returning true.
local function blocking(distance, velocity, acceleration, place)
    local travel, time = motion(distance, velocity, acceleration), 0.0
    run(function(dt)
        time = time + dt
        local s = travel.at(time)
        return place(s) or distance - s <= TOLERANCE
    end)
    return math.max(0.0, time - travel.duration)
end

local function place(object, pose, what, frame)
    if what & POSITION ~= 0 then sim.setObjectPosition(object, {pose[1], pose[2], pose[3]}, frame) end
    if what & ORIENTATION ~= 0 then sim.setObjectQuaternion(object, {pose[4], pose[5], pose[6], pose[7]}, frame) end
end

---------------------------------------------------------------- poses

--- sim.moveToPosition
function M.pose(object, relativeTo, position, angles, velocity, acceleration, distanceBy)
    if not (position or angles) then error('target position and/or target orientation has to be specified.', 2) end
    local what = (position and POSITION or 0) | (angles and ORIENTATION or 0)
    local start = sim.getObjectPose(object, relativeTo)
    local target = sim.buildPose(position or {start[1], start[2], start[3]}, angles or {0, 0, 0})
    if not angles then table.move(start, 4, 7, 4, target) end
    distanceBy = distanceBy or USUAL_DISTANCE
    local distance = sim._getPathDistance(start, target, distanceBy[1], distanceBy[2])
    if distance == 0 then
        place(object, target, what, relativeTo)
        return 0.0
    end
    return blocking(distance, velocity, acceleration, function(s)
        place(object, sim.interpolatePoses(start, target, s / distance), what, relativeTo)
    end)
end

---------------------------------------------------------------- objects

local function targetPose(target, relativePosition)
    if not relativePosition then return sim.getObjectPose(target) end
    if sim.getObjectType(target) ~= sim.sceneobject_path then return nil end
    return sim._getPathPose(target, relativePosition * sim.getPathLength(target))
end

--- sim.moveToObject
function M.object(object, target, what, relativePosition, velocity, acceleration)
    if not (sim.isHandle(object) and sim.isHandle(target)) then error('object or target object does not exist.', 2) end
    if object == target then error('object is same as target object.', 2) end
    what = math.tointeger(what) or POSITION | ORIENTATION
    local start = sim.getObjectPose(object)
    return blocking(1, velocity, acceleration, function(s)
        local pose = sim.isHandle(target) and targetPose(target, relativePosition)
        if not pose or #pose == 0 then return true end
        place(object, sim.interpolatePoses(start, pose, s), what)
    end)
end

---------------------------------------------------------------- joints

local function isMovable(joint)
    if not (math.type(joint) == 'integer' and sim.isHandle(joint)) then return false end
    return sim.getObjectType(joint) == sim.sceneobject_joint and sim.getJointType(joint) ~= sim.joint_spherical
end

-- The way of a joint to its target: the short one if it is cyclic, else within its limits.
local function wayOf(joint, target)
    local position = sim.getJointPosition(joint)
    local cyclic, interval = sim.getJointInterval(joint)
    if cyclic then return position, (target - position + math.pi) % (2 * math.pi) - math.pi end
    local high = interval[1] + interval[2]
    return position, math.max(interval[1], math.min(high, target)) - position
end

local function ways(joints, targets, angleCoefficient)
    local result = {}
    for i, joint in ipairs(joints) do
        if isMovable(joint) then
            checkNumber(targets[i], 'a target', 3)
            local position, way = wayOf(joint, targets[i])
            local isRevolute = sim.getJointType(joint) == sim.joint_revolute
            local distance = math.abs(way) * (isRevolute and angleCoefficient or 1)
            result[#result + 1] = {joint = joint, index = i, start = position, way = way, distance = distance}
        end
    end
    return result
end

-- A kinematic joint with a target would move by itself.
local function setJoint(joint, position)
    local isKinematic = sim.getJointMode(joint) == sim.jointmode_kinematic
    local set = isKinematic and sim.setJointPosition or sim.setJointTargetPosition
    set(joint, position)
end

local function of(value, index) return type(value) == 'table' and value[index] or type(value) == 'number' and value or nil end

--- sim.moveToJointPositions
function M.joints(joints, targets, velocity, acceleration, angleCoefficient)
    local moving, largest = ways(joints, targets, angleCoefficient), 0
    for _, one in ipairs(moving) do largest = math.max(largest, one.distance) end
    if largest == 0 then return 0.0 end
    local longest = 0
    for _, one in ipairs(moving) do
        local together = type(velocity) ~= 'table'
        one.total = together and largest or one.distance
        one.travel = motion(one.total, of(velocity, one.index), of(acceleration, one.index))
        longest = math.max(longest, one.travel.duration)
    end
    local time = 0.0
    run(function(dt)
        time = time + dt
        local isDone = true
        for _, one in ipairs(moving) do
            local s = one.travel.at(time)
            if one.total > 0 and sim.isHandle(one.joint) then setJoint(one.joint, one.start + one.way * (s / one.total)) end
            isDone = isDone and one.total - s <= TOLERANCE
        end
        return isDone
    end)
    return math.max(0.0, time - longest)
end

---------------------------------------------------------------- paths

--- sim.followPath
function M.path(object, path, what, start, velocity, acceleration)
    local isPath = sim.isHandle(path) and sim.getObjectType(path) == sim.sceneobject_path
    if not isPath then error('path does not exist.', 2) end
    checkNumber(velocity, 'velocity', 2)
    local length = sim.getPathLength(path)
    if length == 0 then return 0.0 end
    what = math.tointeger(what) or POSITION
    if what == 0 then what = POSITION end
    acceleration = acceleration and acceleration ~= 0 and math.abs(acceleration) or nil
    local position, speed, step = math.max(0, math.min(1, start)) * length, 0.0, 0.0
    run(function(dt)
        local last = position
        step = dt
        position, speed = sim._travelOnPath(path, position, speed, velocity, acceleration, dt)
        local isAtEnd = velocity >= 0 and (position >= length or position < last)
        local isAtStart = velocity < 0 and (position <= 0 or position > last)
        if isAtEnd then position = length elseif isAtStart then position = 0 end
        -- The end of a closed path is its start.
        local pose = sim._getPathPose(path, position)
        if #pose > 0 then place(object, pose, what) end
        return isAtEnd or isAtStart
    end)
    return step
end

return M
