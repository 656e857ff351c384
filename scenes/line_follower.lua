-- A robot that follows a line: three vision sensors look down and see whether the floor below them is dark.
--
--     swanilda run scenes/line_follower.lua
--     swanilda render scenes/line_follower.lua --time 5 --camera /Watcher -o line_follower.png

sim = require 'sim'

local WHEEL_RADIUS, TRACK = 0.04, 0.16 -- metres
local LINE_WIDTH = 0.03

-- Distance of the line from the middle of the floor, for each direction.
local function radius(angle) return 0.8 + 0.1 * math.cos(3 * angle) end

local function colour(shape, red, green, blue)
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, {red, green, blue})
end

-- A shape that is only seen: nothing collides with it.
local function floor()
    local plane = sim.createPrimitiveShape(sim.primitiveshape_plane, {2.4, 2.4, 0})
    sim.setObjectAlias(plane, 'White')
    sim.setObjectPosition(plane, {0, 0, 0.001})
    colour(plane, 0.95, 0.95, 0.92)
end

-- A closed ribbon of triangles.
local function line()
    local vertices, indices, count = {}, {}, 180
    for i = 0, count - 1 do
        local angle = 2 * math.pi * i / count
        for _, side in ipairs {-1, 1} do
            local r = radius(angle) + side * LINE_WIDTH / 2
            table.insert(vertices, r * math.cos(angle))
            table.insert(vertices, r * math.sin(angle))
            table.insert(vertices, 0.002)
        end
        local a, b = 2 * i, 2 * ((i + 1) % count)
        for _, corner in ipairs {a, a + 1, b + 1, a, b + 1, b} do table.insert(indices, corner) end
    end
    local ribbon = sim.createShape(0, 0, vertices, indices)
    sim.setObjectAlias(ribbon, 'Line')
    colour(ribbon, 0.05, 0.05, 0.05)
end

local function dynamic(shape, alias, mass, parent)
    sim.setObjectAlias(shape, alias)
    sim.setShapeMass(shape, mass)
    sim.setBoolProperty(shape, 'dynamic', true)
    sim.setBoolProperty(shape, 'respondable', true)
    if parent then sim.setObjectParent(shape, parent, true) end
end

local function wheel(alias, y, body)
    local motor = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(motor, alias)
    sim.setObjectPosition(motor, {0, y, WHEEL_RADIUS})
    sim.setObjectOrientation(motor, {-math.pi / 2, 0, 0}) -- the joint turns about its z axis: point it to +y
    sim.setObjectParent(motor, body, true)
    sim.setIntProperty(motor, 'dynCtrlMode', sim.jointdynctrl_velocity)
    sim.setJointTargetForce(motor, 1)
    local tyre = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {2 * WHEEL_RADIUS, 2 * WHEEL_RADIUS, 0.02})
    sim.setObjectPosition(tyre, {0, y, WHEEL_RADIUS})
    sim.setObjectOrientation(tyre, {-math.pi / 2, 0, 0})
    dynamic(tyre, 'Tyre', 0.1, motor)
    sim.setShapeMaterial(tyre, sim.dynmat_wheel)
    colour(tyre, 0.2, 0.2, 0.2)
end

-- A sphere that slides: the third point the robot stands on.
local function caster(body)
    local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.04, 0.04, 0.04})
    sim.setObjectPosition(ball, {-0.07, 0, 0.02})
    dynamic(ball, 'Caster', 0.05)
    sim.setShapeMaterial(ball, sim.dynmat_nofriction)
    local mount = sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.01, 100, 10, 0, 0}) -- a force sensor is a rigid link
    sim.setObjectPosition(mount, {-0.07, 0, 0.02})
    sim.setObjectParent(mount, body, true)
    sim.setObjectParent(ball, mount, true)
end

-- A single pixel that sees a square centimetre of the floor.
local function eye(alias, y, body)
    local sensor = sim.createVisionSensor(0, {1, 1, 0, 0}, {0.002, 0.05, 0.01, 0.01, 0, 0, 0, 0, 0, 0, 0})
    sim.setObjectAlias(sensor, alias)
    sim.setObjectPosition(sensor, {0.1, y, 0.03})
    sim.setObjectOrientation(sensor, {math.pi, 0, 0}) -- it looks along its z axis: down
    sim.setObjectParent(sensor, body, true)
end

local CONTROLLER = [[
sim = require 'sim'

local RADIUS, TRACK, SPEED = 0.04, 0.16, 0.25

local function drive(forward, turn)
    sim.setJointTargetVelocity(left, (forward - turn * TRACK / 2) / RADIUS)
    sim.setJointTargetVelocity(right, (forward + turn * TRACK / 2) / RADIUS)
end

function sysCall_init()
    left, right = sim.getObject('../LeftMotor'), sim.getObject('../RightMotor')
    eyes = {left = sim.getObject('../LeftEye'), middle = sim.getObject('../MiddleEye'), right = sim.getObject('../RightEye')}
    turn = 0
end

-- Number 11 of the first packet is the mean intensity of the picture.
local function isDark(eye)
    local result, packet = sim.readVisionSensor(eye)
    return result >= 0 and packet[11] < 0.5
end

function sysCall_actuation()
    if isDark(eyes.left) then
        turn = 2
    elseif isDark(eyes.right) then
        turn = -2
    elseif isDark(eyes.middle) then
        turn = 0
    end -- else it goes on as before, until one of them sees the line again
    drive(SPEED * (turn == 0 and 1 or 0.6), turn)
end
]]

-- Somebody who looks on from above.
local function watcher()
    local camera = sim.createVisionSensor(1 + 2 + 128, {640, 480, 0, 0}, {0.1, 10, math.rad(50), 0.05, 0, 0, 0.75, 0.85, 0.95, 0, 0})
    sim.setObjectAlias(camera, 'Watcher')
    local from, up = {-1.3, -1.6, 1.5}, {0, 0, 1}
    local function unit(v) local n = math.sqrt(v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2) return {v[1] / n, v[2] / n, v[3] / n} end
    local function cross(a, b) return {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]} end
    local z = unit {-from[1], -from[2], -from[3]}
    local x = unit(cross(up, z))
    local y = cross(z, x)
    sim.setObjectMatrix(camera, {x[1], y[1], z[1], from[1], x[2], y[2], z[2], from[2], x[3], y[3], z[3], from[3]})
end

function sysCall_init()
    floor()
    line()
    watcher()
    body = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.22, 0.12, 0.04})
    sim.setObjectPosition(body, {0, 0, 0.06})
    dynamic(body, 'Robot', 1)
    colour(body, 0.9, 0.4, 0.1)
    sim.setModelProperty(body, 0)
    -- Parts of one tree collide where their low mask bytes meet. They touch by design, so these do not meet.
    sim.setIntProperty(body, 'respondableMask', 0xff01)
    wheel('LeftMotor', TRACK / 2, body)
    wheel('RightMotor', -TRACK / 2, body)
    caster(body)
    eye('LeftEye', 0.02, body)
    eye('MiddleEye', 0, body)
    eye('RightEye', -0.02, body)
    for _, h in ipairs(sim.getObjectsInTree(body, sim.sceneobject_shape, 1)) do sim.setIntProperty(h, 'respondableMask', 0xff02) end
    sim.setObjectParent(sim.createScript(sim.scripttype_simulation, CONTROLLER), body, false)
    sim.setObjectPosition(body, {radius(0), 0, 0.06})
    sim.setObjectOrientation(body, {0, 0, math.pi / 2})
    turned, last, worst, quarters = 0, 0, 0, 0
end

-- How far it has come around the middle, and how far it was from the line.
function sysCall_sensing()
    if finished then return end
    local p = sim.getObjectPosition(body)
    local angle = math.atan(p[2], p[1])
    local step = angle - last
    turned, last = turned + math.atan(math.sin(step), math.cos(step)), angle
    worst = math.max(worst, math.abs(math.sqrt(p[1] ^ 2 + p[2] ^ 2) - radius(angle)))
    if turned >= (quarters + 1) * math.pi / 2 and quarters < 3 then
        quarters = quarters + 1
        print(string.format('%d of 4 quarters after %.1f s', quarters, sim.getSimulationTime()))
    end
    finished = turned >= 2 * math.pi or sim.getSimulationTime() >= 60
    if turned >= 2 * math.pi then
        print(string.format('One lap in %.1f s, never further than %.1f cm from the line.', sim.getSimulationTime(), 100 * worst))
    elseif finished then
        print('Lost.')
    end
    if finished then sim.stopSimulation() end
end
