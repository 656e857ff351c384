-- topic: planning
-- spec: simompl 2, simompl 3, simompl 7; chains of 2 to 12 joints and compounds of all spaces, each state of each path checked by other means; one seed, one path
-- as: simulation
-- passes: 1
sim = require 'sim'
local simOMPL = require 'simOMPL'
local T <const>, A <const> = simOMPL.StateSpaceType, simOMPL.Algorithm
-- Those that end with the first path.
local PLANNERS <const> = {'RRTConnect', 'KPIECE1', 'BKPIECE1', 'LBKPIECE1', 'SBL', 'EST', 'PRM', 'LazyPRM', 'BiTRRT', 'STRIDE', 'LazyRRT'}
local BALL <const>, OBSTACLE <const> = 0.05, 0.15 -- radii

-- A sequence of its own, so that the cases do not depend on the seed.
local drawn = 1
local function random(low, high)
    drawn = (drawn * 16807) % 2147483647
    return low + (high - low) * drawn / 2147483647
end

local function sphere(radius, parent, position)
    local handle = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {2 * radius, 2 * radius, 2 * radius})
    sim.setObjectParent(handle, parent, true)
    sim.setObjectPosition(handle, position, parent)
    return handle
end

local function collection(handles)
    local c = sim.createCollection(0)
    for _, handle in ipairs(handles) do sim.addItemToCollection(c, sim.handle_single, handle, 0) end
    return c
end

local function chain(count)
    local joints, balls, parent = {}, {}, -1
    for i = 1, count do
        local kind = i % 5 == 4 and sim.joint_prismatic or sim.joint_revolute
        local joint = sim.createJoint(kind, sim.jointmode_kinematic, 0)
        sim.setJointInterval(joint, i % 4 == 3 and kind == sim.joint_revolute, kind == sim.joint_prismatic and {0, 0.2} or {-2.5, 5})
        sim.setObjectParent(joint, parent, true)
        sim.setObjectPose(joint, sim.buildPose({0, 0, i == 1 and 0 or 0.2}, {random(-2, 2), random(-1, 1), random(-2, 2)}), parent)
        balls[i] = sphere(BALL, joint, {0, 0, 0.2})
        joints[i], parent = joint, joint
    end
    return joints, balls
end

-- How far the balls are from the obstacles (metres between the surfaces of spheres), after the joints were moved one by one.
local function clearance(joints, balls, obstacles, state)
    for i, joint in ipairs(joints) do sim.setJointPosition(joint, state[i]) end
    local least = math.huge
    for _, ball in ipairs(balls) do
        local p = sim.getObjectPosition(ball)
        for _, obstacle in ipairs(obstacles) do
            local q = sim.getObjectPosition(obstacle)
            least = math.min(least, math.sqrt((p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2) - BALL - OBSTACLE)
        end
    end
    return least
end

local function drawState(joints)
    local state = {}
    for i, joint in ipairs(joints) do
        local cyclic, interval = sim.getJointInterval(joint)
        state[i] = cyclic and random(-3, 3) or interval[1] + interval[2] * random(0.05, 0.95)
    end
    return state
end

local function freeState(robot)
    while true do
        local state = drawState(robot.joints)
        if clearance(robot.joints, robot.balls, robot.obstacles, state) > 0.01 then return state end
    end
end

local function flags(count)
    local list = {}
    for i = 1, count do list[i] = i == 1 and 1 or 0 end
    return list
end

local function task(robot, planner, start, goal)
    local t = simOMPL.createTask('chain')
    simOMPL.setStateSpaceForJoints(t, robot.joints, flags(#robot.joints))
    simOMPL.setAlgorithm(t, A[planner])
    simOMPL.setCollisionPairs(t, {collection(robot.balls), collection(robot.obstacles)})
    simOMPL.setStartState(t, start)
    simOMPL.setGoalState(t, goal)
    simOMPL.setup(t)
    return t
end

-- Spheres are drawn as polyhedra inside of them: what is a little nearer than the spheres may be free.
local SLACK <const> = 0.02

local function checkStates(robot, t)
    local wrong = 0
    for _ = 1, 20 do
        local state = drawState(robot.joints)
        local valid, space = simOMPL.isStateValid(t, state), clearance(robot.joints, robot.balls, robot.obstacles, state)
        -- Surfaces collide: a ball that lies wholly within an obstacle is free.
        local cuts = space < -SLACK and space > SLACK - 2 * BALL
        if valid and cuts or not valid and space > 1e-9 then wrong = wrong + 1 end
    end
    return wrong
end

local function checkPath(robot, path, start, goal)
    local n, wrong = #robot.joints, 0
    for i = 1, n do
        if path[i] ~= start[i] or path[#path - n + i] ~= goal[i] then wrong = wrong + 1 end
    end
    for i = 0, #path - n, n do
        local state = table.move(path, i + 1, i + n, 1, {})
        if clearance(robot.joints, robot.balls, robot.obstacles, state) < -SLACK then wrong = wrong + 1 end
    end
    return wrong
end

local function chains()
    local found, wrong, moved = 0, 0, 0
    for count = 2, 12 do
        local robot = {obstacles = {}}
        robot.joints, robot.balls = chain(count)
        for i = 1, 5 do
            robot.obstacles[i] = sphere(OBSTACLE, -1, {random(-0.8, 0.8), random(-0.8, 0.8), random(0.4, 0.8)})
        end
        local start, goal = freeState(robot), freeState(robot)
        local t = task(robot, PLANNERS[count - 1], start, goal)
        wrong = wrong + checkStates(robot, t)
        local before = simOMPL.readState(t)
        simOMPL.solve(t, 20)
        for i, x in ipairs(simOMPL.readState(t)) do moved = moved + (x == before[i] and 0 or 1) end
        if simOMPL.hasExactSolution(t) then
            found = found + 1
            simOMPL.interpolatePath(t, 0)
            wrong = wrong + checkPath(robot, simOMPL.getPath(t), start, goal)
            simOMPL.simplifyPath(t)
            simOMPL.interpolatePath(t, 0)
            wrong = wrong + checkPath(robot, simOMPL.getPath(t), start, goal)
        else
            print('no path', PLANNERS[count - 1], count)
        end
        simOMPL.destroyTask(t)
        sim.removeObjects(robot.obstacles)
        sim.removeObjects(robot.balls)
        sim.removeObjects(robot.joints)
    end
    print('chains', found, wrong, moved)
end

-- A task with every kind of space. Its bodies must stay out of a ball in the middle of each.
local function compound(planner)
    local spaces, bodies, obstacles = {}, {}, {}
    local function add(kind, low, high, weight)
        local y = 3 * #bodies
        local body = sphere(0.1, -1, {-0.5, y, 0})
        bodies[#bodies + 1] = body
        obstacles[#obstacles + 1] = sphere(0.2, -1, {0, y, 0})
        local frame = sim.createDummy(0.01)
        sim.setObjectPosition(frame, {0, y, 0})
        spaces[#spaces + 1] = simOMPL.createStateSpace('s', kind, body, low, high, 1, weight, frame)
    end
    add(T.position2d, {-1, -1}, {1, 1}, 1)
    add(T.pose2d, {-1, -1}, {1, 1}, 2)
    add(T.position3d, {-1, -1, -1}, {1, 1, 1}, 0.5)
    add(T.pose3d, {-1, -1, -1}, {1, 1, 1}, 1)
    for i = 0, 1 do
        local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
        sim.setJointInterval(joint, i == 1, {-2, 4})
        spaces[#spaces + 1] = simOMPL.createStateSpaceForJoint('j', joint, 0, 1)
    end
    local t = simOMPL.createTask('compound')
    simOMPL.setStateSpace(t, spaces)
    simOMPL.setAlgorithm(t, A[planner])
    simOMPL.setCollisionPairs(t, {collection(bodies), collection(obstacles)})
    local h = math.sqrt(0.5)
    local start = {-0.5, 0, -0.5, 0, 1, -0.5, 0, 0, -0.5, 0, 0, 0, 0, 0, 1, -1, 3}
    local goal = {0.5, 0, 0.5, 0, -2, 0.5, 0, 0, 0.5, 0, 0, 0, 0, h, h, 1, -3}
    simOMPL.setStartState(t, start)
    simOMPL.setGoalState(t, goal)
    simOMPL.setup(t)
    local solved, path = simOMPL.compute(t, 30)
    local hits, outside, different = 0, 0, 0
    for i = 1, simOMPL.getPathStateCount(t, path) do
        local state = simOMPL.getPathState(t, path, i)
        if not simOMPL.isStateWithinBounds(t, state) then outside = outside + 1 end
        simOMPL.writeState(t, state)
        for k, x in ipairs(simOMPL.readState(t)) do
            -- The writing of a quaternion may change all its signs.
            if math.abs(x - state[k]) > 1e-6 and math.abs(x + state[k]) > 1e-6 then different = different + 1 end
        end
        for k, body in ipairs(bodies) do
            local p, q = sim.getObjectPosition(body), sim.getObjectPosition(obstacles[k])
            if math.sqrt((p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2) < 0.3 - SLACK then hits = hits + 1 end
        end
    end
    print('compound', planner, solved, simOMPL.hasExactSolution(t), #path % 17, hits, outside, different)
end

-- Curves of a car around a ball: no turn is sharper than its radius.
local function car(symmetric)
    local body, obstacle = sphere(0.1, -1, {0, 20, 0}), sphere(0.2, -1, {0, 20, 0})
    local frame = sim.createDummy(0.01)
    sim.setObjectPosition(frame, {0, 20, 0})
    local space = simOMPL.createStateSpace('car', T.dubins, body, {-1, -1}, {1, 1}, 1, 1, frame)
    simOMPL.setDubinsParams(space, 0.2, symmetric)
    local t = simOMPL.createTask('car')
    simOMPL.setStateSpace(t, {space})
    simOMPL.setAlgorithm(t, A.RRT)
    simOMPL.setCollisionPairs(t, {body, obstacle})
    simOMPL.setStartState(t, {-0.6, 0, 0})
    simOMPL.setGoalState(t, {0.6, 0, math.pi / 2})
    simOMPL.setup(t)
    simOMPL.solve(t, 30)
    simOMPL.interpolatePath(t, 0)
    local path, hits, sharp = simOMPL.getPath(t), 0, 0
    for i = 1, #path, 3 do
        if math.sqrt(path[i] ^ 2 + path[i + 1] ^ 2) < 0.3 - SLACK then hits = hits + 1 end
        if i > 1 then
            local step = math.sqrt((path[i] - path[i - 3]) ^ 2 + (path[i + 1] - path[i - 2]) ^ 2)
            local turn = math.abs((path[i + 2] - path[i - 1] + math.pi) % (2 * math.pi) - math.pi)
            if turn > step / 0.2 * 1.01 + 1e-6 then sharp = sharp + 1 end
        end
    end
    print('car', symmetric, simOMPL.hasExactSolution(t), hits, sharp)
end

function sysCall_init()
    chains()
    for _, planner in ipairs{'RRTConnect', 'BKPIECE1', 'RRT'} do compound(planner) end
    car(false)
    car(true)
end
