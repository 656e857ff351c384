-- A robot lays a cable: it carries the connector at its end through two clips and plugs it into a socket. simSoft bends the cable, which pulls at the robot.
--
--     swanilda run scenes/cable.lua
--     swanilda render scenes/cable.lua --camera /Camera --time 14 -o cable.png

sim = require 'sim'
simSoft = require 'simSoft'

local RADIUS <const>, SPEED <const>, HOVER <const>, LOW <const> = 0.004, 0.12, 0.1, 0.022 -- metres, metres per second
local CLIPS <const> = {{-0.12, 0, 0}, {0.14, 0.1, math.rad(40)}} -- position and heading
local SOCKET <const> = {0.34, 0.27, math.rad(40)}
local START <const> = {-0.05, -0.3, HOVER, math.rad(90)} -- position and heading of the connector
local GREY <const>, DARK <const>, BLUE <const>, WOOD <const>, RED <const> = {0.8, 0.8, 0.83}, {0.2, 0.2, 0.22}, {0.15, 0.35, 0.7}, {0.75, 0.62, 0.45}, {0.8, 0.25, 0.15}

---------------------------------------------------------------- the scene

local function box(size, position, colour, turn, solid)
    local handle = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectPosition(handle, position)
    sim.setObjectOrientation(handle, {0, 0, turn or 0})
    sim.setShapeColor(handle, nil, sim.colorcomponent_ambient_diffuse, colour)
    sim.setObjectInt32Param(handle, sim.shapeintparam_static, 1)
    sim.setObjectInt32Param(handle, sim.shapeintparam_respondable, solid and 1 or 0)
    return handle
end

-- A place beside another one, forwards and to the left of its heading.
local function beside(place, forwards, left)
    local cos, sin = math.cos(place[3]), math.sin(place[3])
    return place[1] + cos * forwards - sin * left, place[2] + sin * forwards + cos * left
end

local function clip(place)
    for _, side in ipairs{-1, 1} do
        local x, y = beside(place, 0, side * 0.02)
        box({0.04, 0.008, 0.05}, {x, y, 0.025}, BLUE, place[3], true)
    end
end

-- A moving part of the robot on a joint; the motor keeps its position.
local function axis(kind, turn, parent, size, at, mass, colour)
    local joint = sim.createJoint(kind, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(joint, {START[1], START[2], START[3]})
    sim.setObjectOrientation(joint, turn)
    sim.setObjectParent(joint, parent, true)
    sim.setJointInterval(joint, kind == sim.joint_revolute, {-2, 4})
    sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_position)
    sim.setJointPosition(joint, 0)
    sim.setJointTargetPosition(joint, 0)
    sim.setJointTargetForce(joint, 200)
    local part = box(size, at, colour)
    sim.setObjectInt32Param(part, sim.shapeintparam_static, 0)
    sim.setShapeMass(part, mass)
    sim.setObjectParent(part, joint, true)
    return joint, part
end

local function buildRobot()
    local x, y, z = START[1], START[2], START[3]
    local rail = box({1.1, 0.03, 0.03}, {0, -0.5, 0.45}, DARK)
    local carriage, slide, quill
    axes = {}
    axes[1], carriage = axis(sim.joint_prismatic, {0, math.pi / 2, 0}, rail, {0.06, 0.06, 0.05}, {x, -0.5, 0.45}, 2, GREY)
    axes[2], slide = axis(sim.joint_prismatic, {-math.pi / 2, 0, 0}, carriage, {0.05, 0.9, 0.03}, {x, -0.1, 0.49}, 1, GREY)
    axes[3], quill = axis(sim.joint_prismatic, {0, 0, 0}, slide, {0.02, 0.02, 0.45}, {x, y, z + 0.24}, 0.5, DARK)
    axes[4], connector = axis(sim.joint_revolute, {0, 0, 0}, quill, {0.045, 0.018, 0.016}, {x, y, z}, 0.05, RED)
    sim.setObjectOrientation(connector, {0, 0, START[4]})
    sim.setObjectAlias(connector, 'Connector')
end

-- From its box over the table to the back of the connector.
local function buildCable()
    local place = {START[1], START[2], START[4]}
    local x, y = beside(place, -0.022, 0)
    local farX, farY = beside(place, -0.06, 0)
    cable = simSoft.createCable{
        points = {-0.4, 0, 0.02, -0.36, 0, 0.02, -0.3, -0.06, 0.01, -0.36, -0.2, 0.01, -0.47, -0.32, 0.01, -0.3, -0.43, 0.02, farX, farY, HOVER, x, y, HOVER},
        count = 90, radius = RADIUS, bendStiffness = 4e-4, twistStiffness = 4e-4, density = 1500, damping = 0.005, drag = 0.5, friction = 0.3, color = {0.1, 0.1, 0.1},
    }
    sim.setObjectAlias(cable, 'Cable')
    local last = #simSoft.getPoints(cable) // 3 - 1
    simSoft.pin(cable, 0, -1, {clamp = true})
    simSoft.pin(cable, last, connector, {clamp = true})
end

local function addCamera()
    local camera = sim.createVisionSensor(1 + 2 + 128, {640, 480, 0, 0}, {0.05, 10, math.rad(50), 0.05, 0, 0, 0.8, 0.85, 0.9, 0, 0})
    sim.setObjectAlias(camera, 'Camera')
    sim.setObjectPose(camera, sim.buildPose({0.1, 0.85, 0.7}, {-0.12, -0.85, -0.72}, 9, {0, 0, 1}))
end

---------------------------------------------------------------- the way

-- The connector goes straight to a place and turns on the way.
local function go(x, y, z, heading)
    local from, to = {}, {x - START[1], y - START[2], z - START[3], heading - START[4]}
    for i, joint in ipairs(axes) do from[i] = sim.getJointTargetPosition(joint) end
    local way = math.sqrt((to[1] - from[1]) ^ 2 + (to[2] - from[2]) ^ 2 + (to[3] - from[3]) ^ 2)
    local steps = math.max(1, math.ceil(math.max(way, math.abs(to[4] - from[4]) * 0.1) / SPEED / sim.getSimulationTimeStep()))
    for step = 1, steps do
        for i, joint in ipairs(axes) do sim.setJointTargetPosition(joint, from[i] + (to[i] - from[i]) * step / steps) end
        sim.step()
    end
end

local function through(place)
    local x, y = beside(place, -0.06, 0)
    go(x, y, HOVER, place[3])
    go(x, y, LOW, place[3])
    x, y = beside(place, 0.08, 0)
    go(x, y, LOW, place[3])
    go(x, y, 0.05, place[3])
end

-- How far the cable is from the middle of a clip, and how high, where it passes it.
local function inClip(place)
    local points, nearest, height = simSoft.getPoints(cable), math.huge, 0
    for i = 1, #points, 3 do
        local distance = math.sqrt((points[i] - place[1]) ^ 2 + (points[i + 1] - place[2]) ^ 2)
        if distance < nearest then nearest, height = distance, points[i + 2] end
    end
    return nearest, height
end

function sysCall_init()
    box({1.1, 0.9, 0.04}, {0, -0.05, -0.02}, WOOD, 0, true)
    box({0.06, 0.06, 0.05}, {-0.41, 0, 0.025}, DARK)
    for _, place in ipairs(CLIPS) do clip(place) end
    for _, side in ipairs{-1, 1} do
        local x, y = beside(SOCKET, 0, side * 0.017)
        box({0.05, 0.01, 0.04}, {x, y, 0.02}, GREY, SOCKET[3], true)
    end
    buildRobot()
    buildCable()
    addCamera()
    sim.setStepping(true)
end

function sysCall_thread()
    for _, place in ipairs(CLIPS) do through(place) end
    local x, y = beside(SOCKET, -0.06, 0)
    go(x, y, LOW, SOCKET[3])
    go(SOCKET[1], SOCKET[2], LOW, SOCKET[3])
    for _ = 1, 20 do sim.step() end
    for i, place in ipairs(CLIPS) do
        local distance, height = inClip(place)
        print(string.format('clip %d: the cable is %.0f mm from its middle, %.0f mm above the table', i, distance * 1000, height * 1000))
    end
    local position, force = sim.getObjectPosition(connector), simSoft.getPinForce(cable, 90)
    local off = math.sqrt((position[1] - SOCKET[1]) ^ 2 + (position[2] - SOCKET[2]) ^ 2)
    print(string.format('the connector is %.1f mm from its place in the socket; the cable pulls with %.2f N', off * 1000, math.sqrt(force[1] ^ 2 + force[2] ^ 2 + force[3] ^ 2)))
    sim.stopSimulation()
end
