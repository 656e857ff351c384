-- The simulator's side of ros2_lossy.py: echoes, answers and calls services, and publishes what may be lost.
sim = require 'sim'
simROS2 = require 'simROS2'
local SIZE <const> = 100000

local function one_letter(text) return text == text:sub(1, 1):rep(#text) end

function sysCall_init()
    local all = {history = simROS2.qos_history_policy.keep_all}
    local loose_quality = {reliability = simROS2.qos_reliability_policy.best_effort, depth = 500}
    local back = simROS2.createPublisher('/back', 'std_msgs/msg/String', 0, false, all)
    simROS2.createSubscription('/there', 'std_msgs/msg/String', function(message) simROS2.publish(back, message) end, 0, all)
    simROS2.createService('/set', 'std_srvs/srv/SetBool', function(request) return {success = not request.data, message = 'answered'} end)
    local adder = simROS2.createClient('/add', 'example_interfaces/srv/AddTwoInts')
    simROS2.createSubscription('/call', 'std_msgs/msg/Int32', function(message)
        simROS2.waitForService(adder, 20)
        for i = 1, message.data do assert(simROS2.call(adder, {a = i, b = 2}).sum == i + 2) end
        print('called')
    end)
    loose = simROS2.createPublisher('/loose', 'std_msgs/msg/String', 0, false, loose_quality)
    whole, torn = 0, 0
    simROS2.createSubscription('/loose_there', 'std_msgs/msg/String', function(message)
        if one_letter(message.data) then whole = whole + 1 else torn = torn + 1 end
    end, 0, loose_quality)
    simROS2.createSubscription('/report', 'std_msgs/msg/Int32', function() print('loose ' .. whole .. ' ' .. torn) end)
    print('ready')
end

function sysCall_actuation()
    count = (count or 0) + 1
    simROS2.publish(loose, {data = string.char(65 + count % 26):rep(SIZE)})
end
