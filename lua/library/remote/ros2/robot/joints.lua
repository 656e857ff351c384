--[[
Joints of a robot: what they are told, and their states. Internal.
]]

local sim = require('sim')
local simROS2 = require('simROS2')
local topics = require('remote.ros2.robot.topics')

local M = {states = {}}

local MODES <const> = {position = sim.jointdynctrl_position, velocity = sim.jointdynctrl_velocity, effort = sim.jointdynctrl_force}

---------------------------------------------------------------- one joint

local Joint = {}
Joint.__index = Joint

local function isKinematic(object) return sim.getJointMode(object) ~= sim.jointmode_dynamic end

function Joint:position() return sim.getJointPosition(self.object) end
function Joint:velocity() return sim.getJointVelocity(self.object) end

-- Another interface: the motor works in another way, with the force it had at first.
function Joint:enter(interface)
    if self.interface == interface then return end
    self.interface, self.speed = interface, 0
    if self.isKinematic then return end
    if interface ~= 'effort' then sim.setJointTargetForce(self.object, self.force, false) end
    sim.setObjectInt32Param(self.object, sim.jointintparam_dynctrlmode, MODES[interface])
end

function Joint:clamped(value, interface)
    local range = self.ranges[interface]
    return range and math.max(range.min or -math.huge, math.min(range.max or math.huge, value)) or value
end

--- Tells the joint a position, velocity or effort, for this step and those to come.
function Joint:command(interface, value)
    if value ~= value or math.abs(value) == math.huge then return end
    self:enter(interface)
    value = self:clamped(value, interface)
    if interface == 'effort' then
        if not self.isKinematic then sim.setJointTargetForce(self.object, value, true) end
    elseif interface == 'velocity' then
        self.speed = value
        if not self.isKinematic then sim.setJointTargetVelocity(self.object, value) end
    elseif self.isKinematic then
        sim.setJointPosition(self.object, value)
    else
        sim.setJointTargetPosition(self.object, value)
    end
end

--- Has the joint at a position at the end of the step: its motor turns steadily until then, where one in position control would be late. Actuators of MJCF have
--- control of their own.
function Joint:follow(position, step)
    if self.isKinematic or self.hasActuator then return self:command('position', position) end
    self:enter('velocity')
    local speed = (self:clamped(position, 'position') - self:position()) / step
    sim.setJointTargetVelocity(self.object, math.max(-self.fastest, math.min(self.fastest, speed)))
end

--- Moves a joint without a motor by its velocity.
function Joint:actuate(step)
    if self.isKinematic and self.interface == 'velocity' and self.speed ~= 0 then
        sim.setJointPosition(self.object, self:position() + self.speed * step)
    end
end

local function newJoint(name, object)
    return setmetatable({
        name = name, object = object, isKinematic = isKinematic(object), ranges = {},
        force = math.abs(sim.getJointTargetForce(object)), fastest = sim.getObjectFloatParam(object, sim.jointfloatparam_maxvel),
        hasActuator = sim.getStringProperty(object, 'customData.mjcfActuator', {noError = true}) ~= nil,
    }, Joint)
end

---------------------------------------------------------------- all of a robot

local function describedJoints(robot, description, add)
    for _, joint in ipairs(description.joints) do
        local object = robot.body.objects[joint.alias]
        if object and (joint.kind == 'revolute' or joint.kind == 'prismatic') then add(joint.name, object) end
    end
end

local function joinedObjects(robot, add)
    for _, object in ipairs(sim.getObjectsInTree(robot.base, sim.object_joint_type)) do
        if sim.getJointType(object) ~= sim.joint_spherical then add(sim.getObjectAlias(object), object) end
    end
end

local function applyCommands(joints, commands)
    for _, command in ipairs(commands) do
        local joint = joints.byName[command.joint]
        if joint then
            joint.ranges[command.interface] = command
            if command.initial and sim.getSimulationState() == sim.simulation_stopped then
                sim.setJointPosition(joint.object, command.initial)
                if not joint.isKinematic then sim.setJointTargetPosition(joint.object, command.initial) end
            end
        end
    end
end

--- The joints of a robot, by their names in the description, or by the aliases of objects.
function M.new(robot, description)
    local joints = {all = {}, byName = {}}
    local function add(name, object)
        local joint = newJoint(name, object)
        joints.all[#joints.all + 1] = joint
        joints.byName[name] = joints.byName[name] or joint
    end
    if robot.body.isDescribed then describedJoints(robot, description, add) else joinedObjects(robot, add) end
    applyCommands(joints, description.commands)

    --- The joints of these names; an error if one is missing.
    function joints.named(names)
        local found = {}
        for i, name in ipairs(names) do
            found[i] = joints.byName[name] or error(("there is no joint '%s'"):format(name), 0)
        end
        return found
    end

    --- After a simulation motors are as they were before it.
    function joints.release()
        for _, joint in ipairs(joints.all) do joint.interface = nil end
    end

    return joints
end

---------------------------------------------------------------- states

--- Publishes positions, velocities and efforts.
function M.states.new(robot, part)
    local values = part.values
    local joints = values.joints and robot.joints.named(values.joints) or robot.joints.all
    local publisher = robot.topics.publisher(values.topic, 'sensor_msgs/msg/JointState', topics.SENSOR)
    local clock = topics.clock(values.rate)
    local made = {reset = clock.reset}

    function made.sense(time, _, stamp)
        if not clock.isDue(time) then return end
        local message = {header = {stamp = stamp, frame_id = robot.body.root}, name = {}, position = {}, velocity = {}, effort = {}}
        for i, joint in ipairs(joints) do
            message.name[i] = joint.name
            message.position[i], message.velocity[i] = joint:position(), joint:velocity()
            -- Forces of joints are those that act on them, those of ROS what their motors do.
            message.effort[i] = not joint.isKinematic and -(sim.getJointForce(joint.object) or 0) or 0
        end
        simROS2.publish(publisher, message)
    end

    return made
end

return M
