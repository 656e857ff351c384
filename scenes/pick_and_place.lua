-- An arm takes boxes from a conveyor and puts them onto a table behind a wall: a proximity sensor stops the belt, simIK finds postures, simOMPL the ways between them.
--
--     swanilda run scenes/pick_and_place.lua
--     swanilda render scenes/pick_and_place.lua --camera /Camera --time 7 -o pick.png

sim = require 'sim'
simIK = require 'simIK'
simOMPL = require 'simOMPL'

local BOXES, BOX = 3, 0.05 -- boxes, and the length of an edge, metres
local BELT_SPEED, JOINT_SPEED = 0.15, 1.5 -- metres and radians per second
local TOP, GAP, CLEARANCE = 0.2, 0.002, 0.12 -- height of belt and table; boxes stand this far above them; how far above boxes the arm comes and goes
local PICK = {0.5, -0.35}
local PLACES = {{0.42, 0.34}, {0.56, 0.34}, {0.49, 0.46}}
-- Of each joint: its place in the frame of the one before, and how its axis is turned there.
local JOINTS = {
    {{0, 0, 0.1}, {0, 0, 0}}, {{0, 0, 0.15}, {-math.pi / 2, 0, 0}}, {{0.4, 0, 0}, {0, 0, 0}},
    {{0.4, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {math.pi / 2, 0, 0}}, {{0, 0, 0}, {0, math.pi / 2, 0}},
}
local START = {-0.9, -1.2, 1.6, 1.2, -math.pi / 2, 0}
local GREY, DARK, BLUE, WOOD = {0.8, 0.8, 0.83}, {0.25, 0.25, 0.28}, {0.15, 0.35, 0.7}, {0.7, 0.55, 0.35}

local joints, placed, moving, worst = {}, 0, nil, 0

---------------------------------------------------------------- the scene

local function shape(kind, size, parent, position, colour, orientation)
    local handle = sim.createPrimitiveShape(kind, size)
    if parent then sim.setObjectParent(handle, parent, true) end
    sim.setObjectPosition(handle, position, parent or -1)
    sim.setObjectOrientation(handle, orientation or {0, 0, 0}, parent or -1)
    sim.setShapeColor(handle, nil, sim.colorcomponent_ambient_diffuse, colour)
    sim.setObjectInt32Param(handle, sim.shapeintparam_static, 1)
    sim.setObjectInt32Param(handle, sim.shapeintparam_respondable, 0)
    return handle
end

local function cuboid(...) return shape(sim.primitiveshape_cuboid, ...) end
local function cylinder(...) return shape(sim.primitiveshape_cylinder, ...) end

local function joint(kind, parent, matrix, interval)
    local handle = sim.createJoint(kind, sim.jointmode_kinematic, 0)
    sim.setJointInterval(handle, false, interval)
    sim.setObjectParent(handle, parent, true)
    sim.setObjectMatrix(handle, matrix, parent)
    return handle
end

local function buildArm()
    base = sim.createDummy(0.02)
    sim.setObjectAlias(base, 'Arm')
    cylinder({0.2, 0.2, 0.1}, base, {0, 0, 0.05}, DARK)
    local parent = base
    for i, place in ipairs(JOINTS) do
        joints[i] = joint(sim.joint_revolute, parent, sim.buildMatrix(place[1], place[2]), {-math.rad(170), math.rad(340)})
        cylinder({0.09, 0.09, 0.1}, joints[i], {0, 0, 0}, BLUE)
        if i == 2 or i == 3 then cylinder({0.06, 0.06, 0.4}, joints[i], {0.2, 0, 0}, GREY, {0, math.pi / 2, 0}) end
        sim.setJointPosition(joints[i], START[i])
        parent = joints[i]
    end
    return parent
end

-- Two fingers on prismatic joints; the second follows the first.
local function buildGripper(flange)
    cuboid({0.04, 0.12, 0.03}, flange, {0, 0, 0.065}, DARK)
    local function finger(side)
        local slide = joint(sim.joint_prismatic, flange, sim.buildMatrix({0, 0, 0.11}, {-side * math.pi / 2, 0, 0}), {0.02, 0.03})
        cuboid({0.02, 0.06, 0.01}, slide, {0, 0, 0.01}, GREY)
        return slide
    end
    fingers = finger(1)
    local other = finger(-1)
    sim.setJointMode(other, sim.jointmode_dependent, 0)
    sim.setJointDependency(other, fingers, 0, 1)
    tip, target = sim.createDummy(0.02), sim.createDummy(0.02)
    sim.setObjectAlias(tip, 'Tip')
    sim.setObjectParent(tip, flange, true)
    sim.setObjectPose(tip, {0, 0, 0.13, 0, 0, 0, 1}, flange)
    sim.setObjectAlias(target, 'Target')
end

local function buildSurroundings()
    belt = cuboid({0.16, 1.2, 0.04}, nil, {PICK[1], PICK[2] - 0.3, TOP - 0.02}, DARK)
    local rest = cuboid({0.36, 0.36, 0.04}, nil, {0.49, 0.4, TOP - 0.02}, WOOD)
    local wall = cuboid({0.6, 0.03, 0.55}, nil, {0.55, 0.03, 0.275}, {0.75, 0.3, 0.25})
    local floor = cuboid({3, 3, 0.02}, nil, {0, 0, -0.02}, {0.6, 0.62, 0.6})
    obstacles = sim.createCollection(0)
    for _, handle in ipairs{belt, rest, wall, floor} do sim.addItemToCollection(obstacles, sim.handle_single, handle, 0) end
    arm = sim.createCollection(0)
    sim.addItemToCollection(arm, sim.handle_tree, base, 0)
    -- A beam across the belt, at the height of boxes.
    local numbers, lengths = {32, 32, 1, 16, 1, 1, 0, 0}, {0, 0.3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.02, 0, 0}
    beam = sim.createProximitySensor(sim.proximitysensor_ray, 16, 0, numbers, lengths)
    sim.setObjectMatrix(beam, sim.buildMatrix({PICK[1] - 0.15, PICK[2] + BOX / 2, TOP + BOX / 2}, {0, math.pi / 2, 0}))
end

-- Looks along its z axis, with y up; handled explicitly, so that it takes pictures only where one is asked for.
local function addCamera()
    local camera = sim.createVisionSensor(1 + 2 + 128, {480, 360, 0, 0}, {0.1, 10, math.rad(50), 0.05, 0, 0, 0.8, 0.85, 0.9, 0, 0})
    sim.setObjectAlias(camera, 'Camera')
    sim.setObjectPose(camera, sim.buildPose({2.0, 0.3, 1.2}, {-1.7, -0.3, -0.85}, 9, {0, 0, 1}))
end

local function nextBox()
    moving = cuboid({BOX, BOX, BOX}, nil, {PICK[1], PICK[2] - 0.6, TOP + GAP + BOX / 2}, {0.95, 0.7, 0.1})
    sim.setObjectAlias(moving, 'Box')
    sim.setObjectSpecialProperty(moving, sim.objectspecialproperty_collidable | sim.objectspecialproperty_detectable | sim.objectspecialproperty_renderable)
end

-- A step. When a simulation ends it takes the boxes with it, and there is nothing left to do.
local function nextStep()
    repeat sim.step() until sim.getSimulationState() ~= sim.simulation_stopped
end

---------------------------------------------------------------- postures and ways

-- Where the tip is to be: over a point, the fingers down, across the belt.
local function aim(point, height)
    sim.setObjectMatrix(target, sim.buildMatrix({point[1], point[2], height}, {math.pi, 0, math.pi / 2}))
    simIK.syncFromSim(env, {group})
end

-- Postures one after the other, each for a step, as far apart as the speed allows.
local function follow(path)
    local n = #joints
    for i = n + 1, #path, n do
        local longest = 0
        for j = 0, n - 1 do longest = math.max(longest, math.abs(path[i + j] - path[i + j - n])) end
        local steps = math.max(1, math.ceil(longest / (JOINT_SPEED * sim.getSimulationTimeStep())))
        for step = 1, steps do
            for j = 0, n - 1 do
                local from, to = path[i + j - n], path[i + j]
                sim.setJointPosition(joints[j + 1], from + (to - from) * step / steps)
            end
            nextStep()
        end
    end
end

-- The tip goes straight to a height.
local function line(point, height)
    aim(point, height)
    local path = simIK.generatePath(env, group, ikJoints, toIk[tip], 8)
    assert(#path > 0, 'the line is out of reach')
    follow(path)
end

local function isFree(path)
    for i = 1, simOMPL.getPathStateCount(task, path) do
        if not simOMPL.isStateValid(task, simOMPL.getPathState(task, path, i)) then return false end
    end
    return true
end

-- Postures above a height, from which the tip comes straight down to it without touching anything.
local function posturesAbove(point, height)
    aim(point, height + CLEARANCE)
    local configs, free = simIK.findConfigs(env, group, ikJoints, {findMultiple = true, maxTime = 0.05}), {}
    aim(point, height)
    for _, config in ipairs(configs) do
        for i, handle in ipairs(ikJoints) do simIK.setJointPosition(env, handle, config[i]) end
        local path = simIK.generatePath(env, group, ikJoints, toIk[tip], 8)
        if #path > 0 and isFree(path) then free[#free + 1] = config end
    end
    return free
end

-- The arm goes to a posture above a point, around what is in its way.
local function travel(point, height)
    local here = {}
    for i, handle in ipairs(joints) do here[i] = sim.getJointPosition(handle) end
    simOMPL.setStartState(task, here)
    simOMPL.setGoalState(task, here)
    simOMPL.setup(task)
    simOMPL.setGoalStates(task, posturesAbove(point, height))
    simOMPL.setup(task)
    local solved, path = simOMPL.compute(task, 10, -1, 0)
    assert(solved and simOMPL.hasExactSolution(task), 'there is no way')
    follow(path)
    return #path // #joints
end

local function grip(width)
    for step = 1, 10 do
        local now = sim.getJointPosition(fingers)
        sim.setJointPosition(fingers, now + (width / 2 - now) * step / 10)
        nextStep()
    end
end

local function carry(number)
    local box, height = moving, TOP + GAP + BOX / 2
    moving = nil
    local from = sim.getObjectPosition(box)
    local there = travel(from, height)
    line(from, height)
    grip(BOX)
    sim.setObjectParent(box, tip, true)
    line(from, height + CLEARANCE)
    local back = travel(PLACES[number], height)
    line(PLACES[number], height)
    sim.setObjectParent(box, -1, true)
    grip(BOX + 0.04)
    line(PLACES[number], height + CLEARANCE)
    local p = sim.getObjectPosition(box)
    print(string.format('t = %4.1f s   box %d at (%.3f, %.3f, %.3f), by ways of %d and %d postures', sim.getSimulationTime(), number, p[1], p[2], p[3], there, back))
    worst = math.max(worst, math.abs(p[1] - PLACES[number][1]), math.abs(p[2] - PLACES[number][2]))
    placed = placed + 1
end

---------------------------------------------------------------- callbacks

function sysCall_init()
    sim.setBoolProperty(sim.handle_scene, 'dynamicsEnabled', false)
    buildGripper(buildArm())
    buildSurroundings()
    addCamera()
    env = simIK.createEnvironment()
    group = simIK.createGroup(env)
    simIK.setGroupCalculation(env, group, simIK.method_damped_least_squares, 0.01, 50)
    local element
    element, toIk = simIK.addElementFromScene(env, group, base, tip, target, simIK.constraint_pose)
    ikJoints = {}
    for i, handle in ipairs(joints) do ikJoints[i] = toIk[handle] end
    task, touches = simOMPL.createTask('ways'), 0
    simOMPL.setStateSpaceForJoints(task, joints, {1})
    simOMPL.setAlgorithm(task, simOMPL.Algorithm.RRTConnect)
    simOMPL.setCollisionPairs(task, {arm, obstacles})
end

function sysCall_thread()
    sim.setStepping(true)
    for number = 1, BOXES do
        nextBox()
        while sim.readProximitySensor(beam) ~= 1 do
            local p = sim.getObjectPosition(moving)
            sim.setObjectPosition(moving, {p[1], p[2] + BELT_SPEED * sim.getSimulationTimeStep(), p[3]})
            nextStep()
        end
        carry(number)
    end
    print(string.format('%d of %d boxes placed within %.1f mm; the arm has touched something in %d steps.', placed, BOXES, worst * 1000, touches))
    sim.stopSimulation()
end

-- Looks at every step whether the ways are free. While a box is held, it is part of the arm.
function sysCall_sensing()
    if sim.checkCollision(arm, obstacles) == 1 then touches = touches + 1 end
end

function sysCall_cleanup() simIK.eraseEnvironment(env) end
