-- Sends back what comes at fifty topics, and says once which run this is, for those that come later.
sim = require 'sim'
simROS2 = require 'simROS2'

function sysCall_init()
    for i = 1, 50 do
        local back = simROS2.createPublisher('/back_' .. i, 'std_msgs/msg/Int32')
        simROS2.createSubscription('/there_' .. i, 'std_msgs/msg/Int32', function(message)
            simROS2.publish(back, { data = message.data + i })
        end)
    end
    local qos = { history = simROS2.qos_history_policy.keep_last, depth = 1, reliability = simROS2.qos_reliability_policy.reliable,
        durability = simROS2.qos_durability_policy.transient_local }
    local run = simROS2.createPublisher('/run', 'std_msgs/msg/String', 0, false, qos)
    simROS2.publish(run, { data = sim.getNamedStringParam('run') })
end
