-- topic: modules
-- as: customization
-- passes: 0
-- loops: 6
-- spec: ros 2, ros 3
-- note: a node of ROS 2 that talks to itself: messages, services, actions, images, parameters, what is wrong
sim = require 'sim'
simROS2 = require 'simROS2'

-- Other programs on this machine may run the same case.
local place = ('/case_%d_%d'):format(sim.getSystemTime() * 1e6 // 1, sim.getScript(sim.handle_self))
sim.setNamedStringParam('ROS2Interface.domainId', '201')

local function keys(t)
    local names = {}
    for key, value in pairs(t) do names[#names + 1] = ('%s=%s'):format(key, type(value) == 'table' and '{' .. keys(value) .. '}' or value) end
    table.sort(names)
    return table.concat(names, ' ')
end

local function wrong(f, ...) print((select(2, pcall(f, ...)):gsub('^.-: ', '', 1):gsub(('%x'):rep(32), 'GOAL'))) end

function sysCall_init()
    local r = simROS2
    print(keys(r.createInterface('std_msgs/msg/Int32')))
    print(keys(r.createInterface('geometry_msgs/msg/Twist')))
    print(keys(r.createInterface('std_srvs/srv/SetBoolRequest')), keys(r.createInterface('example_interfaces/action/FibonacciGoal')))
    print(keys(r.timeFromFloat(1.5)), r.timeToFloat {sec = 2, nanosec = 250000000})
    print(r.getInterfaceConstants('sensor_msgs/msg/PointField').FLOAT32)
    r.importInterface('geometry_msgs/msg/Vector3')
    print(geometry_msgs.msg.Vector3.__name, keys(geometry_msgs.msg.Vector3.__new()))

    print(r.getParamInt('nope', 5))
    r.setParamDouble('d', 1.5)
    print(r.hasParam('d'), r.getParamDouble('d'))
    wrong(r.getParamString, 'd')
    r.deleteParam('d')
    print(r.hasParam('d'))

    wrong(r.createPublisher, place, 'no_msgs/msg/Thing')
    wrong(r.createPublisher, 'a b', 'std_msgs/msg/Int32')
    wrong(r.createClient, place, 'std_msgs/msg/Int32')
    wrong(r.createActionClient, place, 'std_srvs/srv/SetBool', print, print, print)

    numbers = r.createPublisher(place .. '/n', 'std_msgs/msg/Int32')
    wrong(r.publish, numbers, {data = 1, foo = 2})
    wrong(r.publish, numbers, {data = 'x'})
    wrong(r.publish, 'ff:ptr', {})
    r.createSubscription(place .. '/n', 'std_msgs/msg/Int32', function(m) print('number', m.data) end)

    bytes = r.createPublisher(place .. '/b', 'std_msgs/msg/UInt8MultiArray')
    local as_table = r.createSubscription(place .. '/b', 'std_msgs/msg/UInt8MultiArray', function(m) print('table', #m.data, m.data[2]) end)
    local as_string = r.createSubscription(place .. '/b', 'std_msgs/msg/UInt8MultiArray', 'received')
    r.subscriptionTreatUInt8ArrayAsString(as_string)
    r.publisherTreatUInt8ArrayAsString(bytes)
    wrong(r.publish, bytes, {data = ''})
    wrong(r.shutdownPublisher, as_table)

    local client = r.createClient(place .. '/s', 'std_srvs/srv/SetBool')
    print(r.waitForService(client, 0.05))
    r.createService(place .. '/s', 'std_srvs/srv/SetBool', function(q) return {success = q.data, message = 'ok'} end)
    print(r.waitForService(client, 0.05), keys(r.call(client, {data = true})))
    r.shutdownClient(client)
    wrong(r.call, client, {data = true})

    image = r.imageTransportCreatePublisher(place .. '/i')
    r.imageTransportCreateSubscription(place .. '/i', function(data, w, h) print('image', w, h, data:byte(1), data:byte(-1)) end)
    wrong(r.imageTransportPublish, image, 'abc', 2, 2, 'camera')
    -- Nobody reads what is compressed here, so it is not compressed.
    r.setParamString((place .. '.j.compressed.format'):sub(2), 'tiff')
    r.imageTransportPublish(r.imageTransportCreatePublisher(place .. '/j'), ('\1'):rep(12), 2, 2, 'camera')
    r.setParamString((place .. '.k.compressed.format'):sub(2), 'png')
    compressed = r.imageTransportCreatePublisher(place .. '/k')
    r.imageTransportCreateSubscription(place .. '/k/compressed', function(data, w, h) print('compressed', w, h, data:byte(1), data:byte(-1)) end)

    late = r.createPublisher(place .. '/l', 'std_msgs/msg/Int64', 0, false, {durability = r.qos_durability_policy.transient_local, depth = 2})
    for i = 1, 3 do r.publish(late, {data = i}) end
    r.createSubscription(place .. '/l', 'std_msgs/msg/Int64', function(m) print('late', m.data) end, 0, {durability = r.qos_durability_policy.transient_local})
    wrong(r.createSubscription, place, 'std_msgs/msg/Int64', print, 0, {durability = 1})

    server = r.createActionServer(place .. '/a', 'example_interfaces/action/Fibonacci',
        function(id, goal) return goal.order < 10 and r.goal_response.accept_and_defer or r.goal_response.reject end,
        function() return r.cancel_response.accept end,
        function(id, goal) print('accepted', #id, goal.order) current = id end)
    actions = r.createActionClient(place .. '/a', 'example_interfaces/action/Fibonacci',
        function(_, accepted) print('response', accepted) end,
        function(_, feedback) print('feedback', table.concat(feedback.sequence, ' ')) end,
        function(_, code, result) print('result', code, table.concat(result.sequence, ' ')) end)
    print(r.sendGoal(actions, {order = 11}))
    print(r.sendGoal(actions, {order = 3}))
    wrong(r.actionServerActionSucceed, server, current, {})
    wrong(r.actionServerActionExecute, server, '00', {})
end

function received(m) print('string', #m.data, m.data:byte(2)) end

function sysCall_nonSimulation()
    pass = (pass or 0) + 1
    print('pass', pass)
    if pass == 1 then
        for i = 1, 12 do simROS2.publish(numbers, {data = i}) end
        simROS2.publish(bytes, {data = '\1\200'})
        simROS2.imageTransportPublish(image, ('\1'):rep(6) .. ('\2'):rep(6), 2, 2, 'camera')
        simROS2.imageTransportPublish(compressed, ('\3'):rep(6) .. ('\4'):rep(6), 2, 2, 'camera')
        simROS2.setParamString((place .. '.k.compressed.format'):sub(2), 'tiff')
        wrong(simROS2.imageTransportPublish, compressed, ('\3'):rep(12), 2, 2, 'camera')
        simROS2.sendTransform {header = {frame_id = 'world'}, child_frame_id = 'robot', transform = {translation = {x = 1}}}
        simROS2.actionServerActionExecute(server, current)
        simROS2.actionServerPublishFeedback(server, current, {sequence = {0, 1}})
    elseif pass == 2 then
        simROS2.shutdownPublisher(numbers)
        wrong(simROS2.publish, numbers, {data = 1})
        print(simROS2.cancelLastGoal(actions), simROS2.actionServerActionIsCanceling(server, current))
        simROS2.actionServerActionCanceled(server, current, {sequence = {0, 1, 1}})
    elseif pass == 4 then
        print(simROS2.sendGoal(actions, {order = 1}))
        simROS2.actionServerActionExecute(server, current)
        simROS2.actionServerActionSucceed(server, current, {sequence = {7}})
    end
end
