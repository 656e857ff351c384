--[[
Moves joints along trajectories, told by a topic or the action follow_joint_trajectory: as joint_trajectory_controller has it. Internal.

Between points positions are linear, cubic where points have velocities, and quintic where they have accelerations too.
]]

local sim = require('sim')
local simROS2 = require('simROS2')

local M = {}

local INVALID_GOAL <const>, INVALID_JOINTS <const>, PATH_VIOLATED <const>, GOAL_VIOLATED <const> = -1, -2, -4, -5

---------------------------------------------------------------- trajectories

local function seconds(duration) return duration.sec + duration.nanosec * 1e-9 end

-- The position and velocity after `s` seconds of `length`, between points with what both have.
local function between(a, b, length, s)
    local u, d = s / length, b.p - a.p
    if not (a.v and b.v) then return a.p + d * u, d / length end
    local va, vb = a.v * length, b.v * length
    if not (a.a and b.a) then
        local p = a.p + u * (va + u * (3 * d - 2 * va - vb + u * (va + vb - 2 * d)))
        return p, (va + u * (2 * (3 * d - 2 * va - vb) + 3 * u * (va + vb - 2 * d))) / length
    end
    local aa, ab = a.a * length * length, b.a * length * length
    local c3 = 10 * d - 6 * va - 4 * vb - 1.5 * aa + 0.5 * ab
    local c4 = -15 * d + 8 * va + 7 * vb + 1.5 * aa - ab
    local c5 = 6 * d - 3 * va - 3 * vb - 0.5 * aa + 0.5 * ab
    local p = a.p + u * (va + u * (aa / 2 + u * (c3 + u * (c4 + u * c5))))
    return p, (va + u * (aa + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / length
end

-- Why a message is no trajectory of these joints: a code and a reason; nil if it is one.
local function problemOf(message, byName)
    if #message.points == 0 then return INVALID_GOAL, 'a trajectory without points' end
    if #message.joint_names == 0 then return INVALID_JOINTS, 'a trajectory without joints' end
    for _, name in ipairs(message.joint_names) do
        if not byName[name] then return INVALID_JOINTS, ("joint '%s' does not belong to this controller"):format(name) end
    end
    local before = -1
    for _, point in ipairs(message.points) do
        if #point.positions ~= #message.joint_names then return INVALID_GOAL, 'a point has not one position for each joint' end
        for _, position in ipairs(point.positions) do
            if position ~= position or math.abs(position) == math.huge then return INVALID_GOAL, 'a position is no finite number' end
        end
        local time = seconds(point.time_from_start)
        if time <= before then return INVALID_GOAL, 'times of points do not increase' end
        before = time
    end
end

-- The points of one joint, the first of which is where it is now.
local function curve(message, index, now, start)
    local points = {{t = start, p = now.p, v = now.v, a = 0}}
    for _, point in ipairs(message.points) do
        local t = start + seconds(point.time_from_start)
        local made = {t = t, p = point.positions[index], v = point.velocities[index], a = point.accelerations[index]}
        if t <= points[#points].t then points[#points] = made else points[#points + 1] = made end
    end
    return points
end

-- Position and velocity of a curve; at its end the joint stays.
local function at(points, time)
    local last = points[#points]
    if time >= last.t then return last.p, 0 end
    local i = 1
    while points[i + 1].t <= time do i = i + 1 end
    return between(points[i], points[i + 1], points[i + 1].t - points[i].t, math.max(0, time - points[i].t))
end

---------------------------------------------------------------- the controller

local Controller = {}
Controller.__index = Controller

function Controller:finish(id, how, code, reason)
    if self.goal == id then self.goal = nil end
    local result = {error_code = code}
    if reason then result.error_string = reason end
    if simROS2.actionServerActionIsActive(self.server, id) then how(self.server, id, result) end
end

-- A trajectory replaces the former one, whose goal is aborted.
function Controller:follow(message, goal)
    if self.goal then self:finish(self.goal, simROS2.actionServerActionAbort, INVALID_GOAL, 'another trajectory has replaced it') end
    local time = sim.getSimulationTime()
    local start = math.max(time, seconds(message.header.stamp))
    for index, name in ipairs(message.joint_names) do
        local joint = self.byName[name]
        joint.owner = self
        self.curves[joint] = curve(message, index, {p = joint:position(), v = joint:velocity()}, start)
    end
    self.goal, self.names, self.ends = goal, message.joint_names, start + seconds(message.points[#message.points].time_from_start)
end

function Controller:take(message)
    local _, reason = problemOf(message, self.byName)
    if not reason then return self:follow(message) end
    sim.addLog(sim.verbosity_scriptwarnings, ('%s: %s; it is ignored'):format(self.topic, reason))
end

--- Where joints stay until they are told something.
function Controller:hold()
    for _, joint in ipairs(self.joints) do
        local p = joint:position()
        self.curves[joint] = {{t = 0, p = p, v = 0}}
    end
end

-- Tolerances of positions by names: those of the goal before those of the controller's parameters; 0 is none.
function Controller:tolerances(list, ending)
    local found = {}
    for _, joint in ipairs(self.joints) do found[joint.name] = self.values['constraints.' .. joint.name .. '.' .. ending] end
    for _, one in ipairs(list) do
        if one.position ~= 0 then found[one.name] = one.position end
    end
    return found
end

-- The first joint that is farther from where it should be than it may.
function Controller:violation(time, tolerances)
    for _, joint in ipairs(self.joints) do
        local tolerance = tolerances[joint.name]
        local wanted = self.curves[joint] and at(self.curves[joint], time)
        if wanted and tolerance and tolerance > 0 and math.abs(wanted - joint:position()) > tolerance then return joint.name end
    end
end

local function point(list) return {positions = list.p, velocities = list.v} end

function Controller:feedback(time, stamp)
    local desired, actual, failing = {p = {}, v = {}}, {p = {}, v = {}}, {p = {}, v = {}}
    for i, name in ipairs(self.names) do
        local joint = self.byName[name]
        desired.p[i], desired.v[i] = at(self.curves[joint], time)
        actual.p[i], actual.v[i] = joint:position(), joint:velocity()
        failing.p[i], failing.v[i] = desired.p[i] - actual.p[i], desired.v[i] - actual.v[i]
    end
    simROS2.actionServerPublishFeedback(self.server, self.goal, {
        header = {stamp = stamp}, joint_names = self.names, desired = point(desired), actual = point(actual), error = point(failing),
    })
end

-- Ends the goal that is due: it has come there, it is too far off, or it is cancelled.
function Controller:judge(time)
    local goal, limits = self.goal, self.limits
    if simROS2.actionServerActionIsCanceling(self.server, goal) then
        self:hold()
        return self:finish(goal, simROS2.actionServerActionCanceled, 0, 'cancelled')
    end
    if time < self.ends - 1e-9 then
        local off = self:violation(time, limits.path)
        if not off then return end
        self:hold()
        return self:finish(goal, simROS2.actionServerActionAbort, PATH_VIOLATED, ("joint '%s' is too far from the path"):format(off))
    end
    local off = self:violation(time, limits.goal)
    if not off then return self:finish(goal, simROS2.actionServerActionSucceed, 0) end
    if limits.time > 0 and time > self.ends + limits.time then
        self:finish(goal, simROS2.actionServerActionAbort, GOAL_VIOLATED, ("joint '%s' is too far from its goal"):format(off))
    end
end

function Controller:accept(id, request)
    self.limits = {
        path = self:tolerances(request.path_tolerance, 'trajectory'),
        goal = self:tolerances(request.goal_tolerance, 'goal'),
        time = seconds(request.goal_time_tolerance),
    }
    if self.limits.time == 0 then self.limits.time = self.values['constraints.goal_time'] or 0 end
    self:follow(request.trajectory, id)
end

function Controller:serve(robot, name)
    self.server = robot.topics.action(name .. '/follow_joint_trajectory', 'control_msgs/action/FollowJointTrajectory',
        function(_, request)
            local _, reason = problemOf(request.trajectory, self.byName)
            if reason then sim.addLog(sim.verbosity_scriptwarnings, ('%s: %s; the goal is rejected'):format(self.topic, reason)) end
            return reason and simROS2.goal_response.reject or simROS2.goal_response.accept_and_execute
        end,
        function() return simROS2.cancel_response.accept end,
        function(id, request) self:accept(id, request) end)
end

--- The joints are told where they have to be at the end of the step. One that somebody else has told something belongs to that one.
function Controller:actuate(time, step)
    for joint, points in pairs(self.curves) do
        if joint.owner ~= self then
            self.curves[joint] = nil
        else
            joint:follow((at(points, time + step)), step)
        end
    end
end

function M.new(robot, part)
    local values = part.values
    local self = setmetatable({values = values, joints = robot.joints.named(values.joints), byName = {}, curves = {}}, Controller)
    for _, joint in ipairs(self.joints) do self.byName[joint.name] = joint end
    self.topic = robot.topics.resolve(values.topic)
    robot.topics.subscription(values.topic, 'trajectory_msgs/msg/JointTrajectory', function(message) self:take(message) end)
    self:serve(robot, part.name)
    return {
        actuate = function(time, step) self:actuate(time, step) end,
        sense = function(time, step, stamp)
            if not self.goal then return end
            self:feedback(time + step, stamp)
            self:judge(time + step)
        end,
        claim = function()
            for _, joint in ipairs(self.joints) do
                if not joint.interface then joint:enter('position') end
            end
        end,
        reset = function()
            if self.goal then self:finish(self.goal, simROS2.actionServerActionAbort, INVALID_GOAL, 'the simulation has ended') end
            self.curves = {}
        end,
    }
end

return M
