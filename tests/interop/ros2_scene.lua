-- The simulator's side of ros2_peers.py: echoes topics, answers a service, calls one on request.
sim = require 'sim'
simROS2 = require 'simROS2'
r = simROS2

function sysCall_init()
    local hinge = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    local tip = sim.createDummy(0.1)
    sim.setObjectAlias(hinge, 'Hinge')
    sim.setObjectAlias(tip, 'Tip')
    sim.setObjectParent(tip, hinge, true)
    sim.setObjectPosition(tip, {1, 0, 0})
    sim.setJointPosition(hinge, 0.5)
    echo = r.createPublisher('/back', 'std_msgs/msg/String', 0, false, {history = r.qos_history_policy.keep_all})
    r.createSubscription('/there', 'std_msgs/msg/String', function(m) r.publish(echo, {data = m.data}) end, 0, {depth = 500})
    latched = r.createPublisher('/latched', 'std_msgs/msg/String', 0, false,
        {durability = r.qos_durability_policy.transient_local, depth = 2})
    for _, text in ipairs {'one', 'two', 'three'} do r.publish(latched, {data = text}) end
    local sensor = {reliability = r.qos_reliability_policy.best_effort}
    scans = r.createPublisher('/scan', 'sensor_msgs/msg/LaserScan', 0, false, sensor)
    r.createSubscription('/best_effort', 'geometry_msgs/msg/Twist', function(m)
        print('twist ' .. m.linear.x .. ' ' .. m.angular.z)
    end, 0, sensor)
    r.createSubscription('/flood', 'std_msgs/msg/Int32', function(m) count = (count or 0) + 1 newest = m.data end, 0, {depth = 5})
    r.createSubscription('/block', 'std_msgs/msg/Float64', function(m)
        -- Nothing is read meanwhile.
        local stop = sim.getSystemTime() + m.data
        count, newest = 0, nil
        while sim.getSystemTime() < stop do end
        blocked = true
    end)
    server = r.createService('/set', 'std_srvs/srv/SetBool', function(q)
        return {success = not q.data, message = 'answered ' .. tostring(q.data)}
    end)
    adder = r.createClient('/add', 'example_interfaces/srv/AddTwoInts')
    r.createSubscription('/call', 'std_msgs/msg/Int32', function(m)
        print('service ' .. tostring(r.waitForService(adder, 10)))
        print('sum ' .. r.call(adder, {a = m.data, b = 2 ^ 40}).sum)
    end)
    print('ready')
end

function sysCall_actuation()
    r.publish(scans, {header = {frame_id = 'laser'}, ranges = {1, 2.5, sim.getSimulationTime()}})
    if blocked and newest then
        print('flood ' .. count .. ' ' .. newest)
        blocked = nil
    end
end
