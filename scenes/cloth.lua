-- A gripper lifts a soft ball and lays it on a cloth that is held at its corners; another cloth falls over a post. simSoft moves the cloths and the ball, and what they do to the robot.
--
--     swanilda run scenes/cloth.lua
--     swanilda render scenes/cloth.lua --camera /Camera --time 7 -o cloth.png

sim = require 'sim'
simSoft = require 'simSoft'

local RADIUS <const>, SPEED <const>, HIGH <const> = 0.05, 0.2, 0.4 -- metres, metres per second
local BALL <const>, TARGET <const> = {-0.3, 0, RADIUS}, {0.25, 0, 0.2} -- where the ball lies, and the middle of the cloth
local OPEN <const>, GRIP <const> = 0.07, 0.032 -- of each finger from the middle, metres
local GREY <const>, DARK <const>, WOOD <const> = {0.8, 0.8, 0.83}, {0.2, 0.2, 0.22}, {0.75, 0.62, 0.45}

---------------------------------------------------------------- the scene

local function shape(kind, size, position, colour, solid)
    local handle = sim.createPrimitiveShape(kind, size)
    sim.setObjectPosition(handle, position)
    sim.setShapeColor(handle, nil, sim.colorcomponent_ambient_diffuse, colour)
    sim.setObjectInt32Param(handle, sim.shapeintparam_static, 1)
    sim.setObjectInt32Param(handle, sim.shapeintparam_respondable, solid and 1 or 0)
    return handle
end

-- A moving part on a prismatic joint whose motor keeps its position.
local function axis(turn, parent, size, at, mass, colour, solid)
    local joint = sim.createJoint(sim.joint_prismatic, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(joint, at)
    sim.setObjectOrientation(joint, turn)
    sim.setObjectParent(joint, parent, true)
    sim.setJointInterval(joint, false, {-1, 2})
    sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_position)
    sim.setJointPosition(joint, 0)
    sim.setJointTargetPosition(joint, 0)
    sim.setJointTargetForce(joint, 200)
    local part = shape(sim.primitiveshape_cuboid, size, at, colour, solid)
    sim.setObjectInt32Param(part, sim.shapeintparam_static, 0)
    sim.setShapeMass(part, mass)
    sim.setObjectParent(part, joint, true)
    return joint, part
end

local function buildRobot()
    local x = BALL[1]
    local rail = shape(sim.primitiveshape_cuboid, {1.2, 0.04, 0.04}, {0, 0.3, 0.75}, DARK)
    local carriage, palm
    along, carriage = axis({0, math.pi / 2, 0}, rail, {0.08, 0.7, 0.04}, {x, 0, 0.75}, 2, GREY)
    up, palm = axis({0, 0, 0}, carriage, {0.04, 0.18, 0.03}, {x, 0, HIGH}, 0.5, DARK)
    fingers = {}
    for i, side in ipairs{-1, 1} do
        local finger
        fingers[i], finger = axis({side * -math.pi / 2, 0, 0}, palm, {0.05, 0.012, 0.12}, {x, side * OPEN, HIGH - 0.07}, 0.1, GREY, true)
        sim.setObjectAlias(finger, 'Finger' .. i)
    end
end

local function buildSoft()
    local solid = shape(sim.primitiveshape_spheroid, {2 * RADIUS, 2 * RADIUS, 2 * RADIUS}, BALL, DARK)
    ball = simSoft.createVolume{shape = solid, cell = 0.02, young = 4e4, density = 300, friction = 1, color = {0.85, 0.4, 0.15}}
    sim.removeObjects{solid}
    sim.setObjectAlias(ball, 'Ball')
    cloth = simSoft.createCloth{size = {0.4, 0.4}, count = {14, 14}, pose = {TARGET[1], TARGET[2], TARGET[3], 0, 0, 0, 1}, thickness = 0.004, areaDensity = 0.3, stretchStiffness = 800, bendStiffness = 2e-5, color = {0.25, 0.4, 0.7}}
    sim.setObjectAlias(cloth, 'Cloth')
    for _, corner in ipairs{0, 14, 210, 224} do
        local points = simSoft.getPoints(cloth)
        local x, y = points[3 * corner + 1], points[3 * corner + 2]
        local post = shape(sim.primitiveshape_cylinder, {0.012, 0.012, TARGET[3]}, {x, y, TARGET[3] / 2}, DARK)
        simSoft.pin(cloth, corner, post)
    end
    shape(sim.primitiveshape_spheroid, {0.16, 0.16, 0.16}, {-0.25, -0.38, 0.17}, GREY, true)
    shape(sim.primitiveshape_cylinder, {0.02, 0.02, 0.16}, {-0.25, -0.38, 0.08}, GREY, true)
    draped = simSoft.createCloth{size = {0.36, 0.36}, count = {18, 18}, pose = {-0.25, -0.38, 0.3, 0, 0, 0, 1}, thickness = 0.004, areaDensity = 0.25, stretchStiffness = 300, bendStiffness = 1e-5, color = {0.75, 0.75, 0.3}}
    sim.setObjectAlias(draped, 'Draped')
end

local function addCamera()
    local camera = sim.createVisionSensor(1 + 2 + 128, {640, 480, 0, 0}, {0.05, 10, math.rad(50), 0.05, 0, 0, 0.8, 0.85, 0.9, 0, 0})
    sim.setObjectAlias(camera, 'Camera')
    sim.setObjectPose(camera, sim.buildPose({0.35, -1.15, 0.75}, {-0.35, 1.05, -0.6}, 9, {0, 0, 1}))
end

---------------------------------------------------------------- the way

-- Moves the hand from where it is to a place.
local function go(x, z)
    local from = {sim.getJointTargetPosition(along), sim.getJointTargetPosition(up)}
    local to = {x - BALL[1], z - HIGH}
    local way = math.max(math.abs(to[1] - from[1]), math.abs(to[2] - from[2]))
    local steps = math.ceil(way / SPEED / sim.getSimulationTimeStep())
    for step = 1, steps do
        sim.setJointTargetPosition(along, from[1] + (to[1] - from[1]) * step / steps)
        sim.setJointTargetPosition(up, from[2] + (to[2] - from[2]) * step / steps)
        sim.step()
    end
end

-- Fingers close or open.
local function grip(closed)
    for step = 1, 20 do
        local way = (OPEN - GRIP) * step / 20
        for _, finger in ipairs(fingers) do sim.setJointTargetPosition(finger, closed and -way or way + GRIP - OPEN) end
        sim.step()
    end
end

local function middle(handle)
    local points, sum = simSoft.getPoints(handle), {0, 0, 0}
    for i = 0, #points - 1 do sum[i % 3 + 1] = sum[i % 3 + 1] + points[i + 1] * 3 / #points end
    return sum
end

function sysCall_init()
    shape(sim.primitiveshape_cuboid, {1.3, 1.1, 0.04}, {0, -0.05, -0.02}, WOOD, true)
    buildRobot()
    buildSoft()
    addCamera()
    sim.setStepping(true)
end

function sysCall_thread()
    go(BALL[1], RADIUS + 0.085)
    grip(true)
    go(BALL[1], HIGH)
    print(string.format('the ball is lifted by %.0f mm', (middle(ball)[3] - RADIUS) * 1000))
    go(TARGET[1], HIGH)
    go(TARGET[1], TARGET[3] + RADIUS + 0.08)
    grip(false)
    go(TARGET[1], HIGH)
    for _ = 1, 20 do sim.step() end
    local at = middle(ball)
    print(string.format('the ball lies %.0f mm from the middle of the cloth, %.0f mm above the table', math.sqrt((at[1] - TARGET[1]) ^ 2 + at[2] ^ 2) * 1000, at[3] * 1000))
    sim.stopSimulation()
end
