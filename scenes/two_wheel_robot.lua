-- A differential drive that visits waypoints. The route is one threaded child script: it reads like a list of errands.
--
--     swanilda run scenes/two_wheel_robot.lua

sim = require 'sim'

local WHEEL_RADIUS, TRACK = 0.05, 0.24 -- metres

local function dynamic(shape, alias, mass, parent)
    sim.setObjectAlias(shape, alias)
    sim.setShapeMass(shape, mass)
    sim.setBoolProperty(shape, 'dynamic', true)
    sim.setBoolProperty(shape, 'respondable', true)
    if parent then sim.setObjectParent(shape, parent, true) end
    return shape
end

local function wheel(alias, y, body)
    local motor = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(motor, alias)
    sim.setObjectPosition(motor, {0, y, WHEEL_RADIUS})
    sim.setObjectOrientation(motor, {-math.pi / 2, 0, 0}) -- the joint turns about its z axis: point it to +y
    sim.setObjectParent(motor, body, true)
    sim.setIntProperty(motor, 'dynCtrlMode', sim.jointdynctrl_velocity)
    sim.setJointTargetVelocity(motor, 0)
    sim.setJointTargetForce(motor, 2)

    local tyre = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {2 * WHEEL_RADIUS, 2 * WHEEL_RADIUS, 0.02})
    sim.setObjectPosition(tyre, {0, y, WHEEL_RADIUS})
    sim.setObjectOrientation(tyre, {-math.pi / 2, 0, 0})
    dynamic(tyre, 'Tyre', 0.2, motor)
    sim.setShapeMaterial(tyre, sim.dynmat_wheel)
end

-- A sphere that slides: the third point the robot stands on.
local function caster(body)
    local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.05, 0.05, 0.05})
    sim.setObjectPosition(ball, {-0.1, 0, 0.025})
    dynamic(ball, 'Caster', 0.1)
    sim.setShapeMaterial(ball, sim.dynmat_nofriction)
    local mount = sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.02, 100, 10, 0, 0}) -- a force sensor is a rigid link
    sim.setObjectPosition(mount, {-0.1, 0, 0.025})
    sim.setObjectParent(mount, body, true)
    sim.setObjectParent(ball, mount, true)
end

local ROUTE = [[
sim = require 'sim'

local RADIUS, TRACK = 0.05, 0.24
local SPEED = 0.4 -- metres per second
local STOPS = {{1, 0}, {1, 1}, {0, 1}, {0, 0}}

local function drive(forward, turn)
    sim.setJointTargetVelocity(left, (forward - turn * TRACK / 2) / RADIUS)
    sim.setJointTargetVelocity(right, (forward + turn * TRACK / 2) / RADIUS)
end

-- Distance and bearing of a point, as the robot sees it.
local function look(stop)
    local p, heading = sim.getObjectPosition(body), sim.getObjectOrientation(body)[3]
    local dx, dy = stop[1] - p[1], stop[2] - p[2]
    local bearing = math.atan(dy, dx) - heading
    return math.sqrt(dx * dx + dy * dy), math.atan(math.sin(bearing), math.cos(bearing))
end

local function goTo(stop)
    local distance, bearing = look(stop)
    while distance > 0.05 do
        drive(SPEED * math.max(0, math.cos(bearing)) ^ 3, 3 * bearing)
        sim.step() -- one simulation step goes by
        distance, bearing = look(stop)
    end
end

function sysCall_init()
    body = sim.getObject('..')
    left, right = sim.getObject('../Left'), sim.getObject('../Right')
end

function sysCall_thread()
    sim.setStepping(true)
    for i, stop in ipairs(STOPS) do
        goTo(stop)
        local p = sim.getObjectPosition(body)
        print(string.format('t = %5.2f s   stop %d reached: (%.2f, %.2f)', sim.getSimulationTime(), i, p[1], p[2]))
    end
    drive(0, 0)
    sim.wait(0.5)
    print('Home again.')
    sim.stopSimulation()
end
]]

function sysCall_init()
    local body = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.3, 0.2, 0.06})
    sim.setObjectPosition(body, {0, 0, 0.08})
    dynamic(body, 'Robot', 2)
    sim.setModelProperty(body, 0)
    -- Parts of one tree collide where their low mask bytes meet. They touch by design, so these do not meet.
    sim.setIntProperty(body, 'respondableMask', 0xff01)
    wheel('Left', TRACK / 2, body)
    wheel('Right', -TRACK / 2, body)
    caster(body)
    for _, h in ipairs(sim.getObjectsInTree(body, sim.sceneobject_shape, 1)) do
        sim.setIntProperty(h, 'respondableMask', 0xff02)
    end
    sim.setObjectParent(sim.createScript(sim.scripttype_simulation, ROUTE), body, false)
end

-- A robot that has lost its way should not drive for ever.
function sysCall_sensing()
    if sim.getSimulationTime() >= 60 then
        print('Lost.')
        sim.stopSimulation()
    end
end
