--[[
Passes numbers to joints, one for each: `std_msgs/Float64MultiArray`, as forward_command_controller has it. Internal.
]]

local sim = require('sim')

local M = {}

function M.new(robot, part)
    local values = part.values
    local joints, interface = robot.joints.named(values.joints), values.interface_name
    local made = {}

    robot.topics.subscription(values.topic, 'std_msgs/msg/Float64MultiArray', function(message)
        if #message.data ~= #joints then
            local text = '%s: %d numbers for %d joints are ignored'
            return sim.addLog(sim.verbosity_scriptwarnings, text:format(robot.topics.resolve(values.topic), #message.data, #joints))
        end
        for i, joint in ipairs(joints) do
            joint.owner = made
            joint:command(interface, message.data[i])
        end
    end)

    --- A motor of another kind stands still until it is told something; at its position it stays.
    function made.claim()
        for _, joint in ipairs(joints) do
            if interface ~= 'position' and not joint.interface then joint:command(interface, 0) end
        end
    end

    function made.actuate(_, step)
        for _, joint in ipairs(joints) do
            if joint.interface == interface then joint:actuate(step) end
        end
    end

    return made
end

return M
