-- A cart that is driven by commands of a node which sees where it is. The commands are made of what was published in the step before.
sim = require 'sim'
simROS2 = require 'simROS2'

local cart, place
local speed, trim, commands, x = 0, 0, 0, 0

function onCommand(message)
    speed, commands = message.twist.linear.x, commands + 1
end

function onTrim(message) trim = message.data end

function sysCall_init()
    cart = sim.createPrimitiveShape(sim.primitiveshape_cuboid, { 0.2, 0.2, 0.1 }, 0)
    sim.setObjectInt32Param(cart, sim.shapeintparam_static, 1)
    place = simROS2.createPublisher('/place', 'geometry_msgs/msg/PointStamped')
    simROS2.createSubscription('/command', 'geometry_msgs/msg/TwistStamped', 'onCommand')
    simROS2.createSubscription('/trim', 'std_msgs/msg/Float64', 'onTrim')
end

function sysCall_actuation()
    local p = sim.getObjectPosition(cart)
    p[1] = p[1] + (speed + trim) * sim.getSimulationTimeStep()
    sim.setObjectPosition(cart, p)
end

function sysCall_sensing()
    x = sim.getObjectPosition(cart)[1]
    simROS2.publish(place, { header = { stamp = simROS2.getSimulationTime(), frame_id = 'world' }, point = { x = x } })
end

function sysCall_afterSimulation() print(('%.17g after %d commands'):format(x, commands)) end
