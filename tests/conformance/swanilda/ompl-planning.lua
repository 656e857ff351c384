-- topic: planning
-- spec: simompl 3, simompl 5, simompl 7, simompl 8; every planner, paths, callbacks, goals
-- tol: 1e-6
-- as: simulation
-- passes: 1
sim = require 'sim'
local simOMPL = require 'simOMPL'
local T <const>, A <const> = simOMPL.StateSpaceType, simOMPL.Algorithm

local robot, wall, space
local optimising <const> = {BITstar = true, CForest = true, LazyPRMstar = true, LBTRRT = true, PRMstar = true, RRTstar = true, SPARS = true, SPARStwo = true}

local function fails(f, ...)
    local fine, message = pcall(f, ...)
    return fine and 'no error' or (message:gsub('^.*in simOMPL%.[%w_]+: ', ''))
end

local function task(algorithm, projected)
    local t = simOMPL.createTask('t')
    local s = projected == 0 and simOMPL.createStateSpace('p', T.position2d, robot, {-1, -1}, {1, 1}, 0) or space
    simOMPL.setStateSpace(t, {s})
    simOMPL.setAlgorithm(t, algorithm)
    simOMPL.setStartState(t, {-0.5, 0})
    simOMPL.setGoalState(t, {0.5, 0})
    return t
end

local function blocked(algorithm)
    local t = task(algorithm)
    simOMPL.setCollisionPairs(t, {-1, wall, robot, wall, robot})
    simOMPL.setup(t)
    return t
end

-- Each state of a path, asked of the scene itself.
local function isFree(t, path)
    local before = sim.getObjectPosition(robot)
    for i = 1, simOMPL.getPathStateCount(t, path) do
        local state = simOMPL.getPathState(t, path, i)
        if not simOMPL.isStateValid(t, state) then return false end
        sim.setObjectPosition(robot, {state[1], state[2], 0})
        if sim.checkCollision(robot, wall) ~= 0 then return false end
    end
    sim.setObjectPosition(robot, before)
    return true
end

local function open()
    local t = task(A.RRTConnect)
    simOMPL.setup(t)
    print('open', simOMPL.compute(t, 1, -1, 5))
    print(simOMPL.hasExactSolution(t), simOMPL.hasApproximateSolution(t), simOMPL.hasSolution(t), simOMPL.getGoalDistance(t))
    simOMPL.interpolatePath(t, 3)
    print('unchanged', simOMPL.getPathStateCount(t, simOMPL.getPath(t)))
    t = task(A.RRTConnect)
    simOMPL.setup(t)
    simOMPL.solve(t, 1)
    simOMPL.simplifyPath(t)
    simOMPL.interpolatePath(t, 0)
    local path = simOMPL.getPath(t)
    local longest = 0
    for i = 3, #path, 2 do longest = math.max(longest, math.sqrt((path[i] - path[i - 2]) ^ 2 + (path[i + 1] - path[i - 1]) ^ 2)) end
    print('dense', #path // 2, longest <= 0.0282843, fails(simOMPL.interpolatePath, t, 1 << 40))
end

local function everyPlanner()
    local names = {}
    for name in pairs(A) do names[#names + 1] = name end
    table.sort(names)
    for _, name in ipairs(names) do
        local t = blocked(A[name])
        -- Those that end with the first path do not need it; the others make it shorter.
        local solved = simOMPL.solve(t, optimising[name] and 1 or 60)
        local exact = simOMPL.hasExactSolution(t)
        if not (solved and exact) then
            print(name, solved, exact)
        else
            simOMPL.simplifyPath(t)
            simOMPL.interpolatePath(t, 0)
            local path = simOMPL.getPath(t)
            local ends = path[1] == -0.5 and path[2] == 0 and path[#path - 1] == 0.5 and path[#path] == 0
            if not ends or not isFree(t, path) then print(name, 'wrong', ends) end
        end
    end
    print(#names .. ' planners', sim.getObjectPosition(robot))
end

local function callbacks()
    local t = task(A.RRTConnect)
    local moved = false
    simOMPL.setStateValidationCallback(t, function(s)
        moved = moved or sim.getObjectPosition(robot)[1] ~= 0
        return s[1] < 0
    end)
    simOMPL.setup(t)
    print('half', simOMPL.solve(t, 60), simOMPL.hasExactSolution(t), moved, simOMPL.isStateValid(t, {0.1, 0}))
    function broken() error('oh') end
    function silent() end
    function half() return true end
    function reached(s) return s[1] > 0.4, math.max(0, 0.4 - s[1]) end
    for _, name in ipairs{'broken', 'silent', 'missing'} do
        simOMPL.setStateValidationCallback(t, name)
        print(fails(simOMPL.solve, t, 1))
    end
    print(fails(simOMPL.isStateValid, t, {0, 0}))
    simOMPL.setStateValidationCallback(t, '')
    simOMPL.setup(t)
    print('reset', simOMPL.solve(t, 1))
    t = task(A.RRT)
    for _, name in ipairs{'half', 'broken', 'reached'} do
        simOMPL.setGoalCallback(t, name)
        simOMPL.setup(t)
        print('goal', name, fails(simOMPL.solve, t, 1))
    end
    print(simOMPL.hasExactSolution(t), simOMPL.getPathState(t, simOMPL.getPath(t), -1)[1] > 0.4)
    t = task(A.RRTConnect)
    simOMPL.setGoalCallback(t, 'reached')
    simOMPL.setup(t)
    print('refused', simOMPL.solve(t, 1), simOMPL.hasSolution(t))
    t = task(A.KPIECE1, 0)
    simOMPL.setup(t)
    print(fails(simOMPL.solve, t, 1), simOMPL.projectStates(t, {0, 0}))
    simOMPL.setProjectionEvaluationCallback(t, function(s) return {s[1] + s[2], 1, 2} end, 1)
    print('projected', simOMPL.projectStates(t, {0.25, 0.5}), simOMPL.solve(t, 1))
    simOMPL.setProjectionEvaluationCallback(t, 'half', 1)
    print(fails(simOMPL.projectStates, t, {0.25, 0.5}), fails(simOMPL.solve, t, 1))
    t = task(A.PRM)
    local asked = 0
    simOMPL.setValidStateSamplerCallback(t, function() asked = asked + 1 return {math.random() - 0.5, 0.9} end, 'broken')
    simOMPL.setStateValidationCallback(t, function(s) return math.abs(s[1]) > 0.3 or s[2] > 0.8 end)
    simOMPL.setup(t)
    print('sampled', simOMPL.solve(t, 1), asked > 0)
    simOMPL.setValidStateSamplerCallback(t, 'silent', 'silent')
    simOMPL.setup(t)
    print(fails(simOMPL.solve, t, 1))
    local nested
    t = task(A.RRTConnect)
    simOMPL.setStateValidationCallback(t, function(s)
        nested = nested or fails(simOMPL.solve, t, 1)
        simOMPL.writeState(t, s)
        return simOMPL.isStateWithinBounds(t, simOMPL.readState(t))
    end)
    simOMPL.setup(t)
    print('nested', simOMPL.solve(t, 1), nested)
    simOMPL.writeState(t, {0, 0})
end

local function dummies()
    local t, target = task(A.RRT), sim.createDummy(0.01)
    sim.setObjectPosition(target, {0.3, 0.4, 0.9})
    simOMPL.setGoal(t, robot, target, 0.05, {1, 1, 0, 0})
    simOMPL.setup(t)
    print('dummies', simOMPL.solve(t, 2), simOMPL.hasExactSolution(t), simOMPL.projectionSize(t))
    local state = simOMPL.getPathState(t, simOMPL.getPath(t), -1)
    print((state[1] - 0.3) ^ 2 + (state[2] - 0.4) ^ 2 <= 0.0025, sim.getObjectPosition(robot))
    sim.removeObjects{target}
    simOMPL.setup(t)
    print(fails(simOMPL.solve, t, 1))
    t = blocked(A.RRTConnect)
    simOMPL.setCollisionPairs(t, {robot, 123456})
    print(fails(simOMPL.solve, t, 1))
end

local function again()
    local t = blocked(A.PRM)
    print('roadmap', simOMPL.solve(t, 2), #simOMPL.getPath(t) > 4)
    local states, tags, tagsReal, edges, weights, starts, goals = simOMPL.getPlannerData(t)
    print(#states == 2 * #tags, #tags == #tagsReal, #edges == 2 * #weights, #starts, #goals)
    simOMPL.setStartState(t, {-0.6, 0.1})
    print(simOMPL.hasSolution(t), simOMPL.solve(t, 2), simOMPL.getPathState(t, simOMPL.getPath(t), 1))
    print(#simOMPL.getPlannerData(t) > #states)
    t = blocked(A.RRTConnect)
    for _, start in ipairs{{0, 0}, {5, 5}, {0 / 0, 0}} do
        simOMPL.setStartState(t, start)
        simOMPL.setup(t)
        print(simOMPL.solve(t, 1), simOMPL.compute(t, 0.1))
    end
    local function plan()
        local p = blocked(A.RRTConnect)
        simOMPL.solve(p, 1)
        return simOMPL.getPath(p)
    end
    local a, b = plan(), plan()
    local same = #a == #b
    for i, x in ipairs(a) do same = same and x == b[i] end
    print('draws go on', same)
    for _, time in ipairs{0, -1, 0 / 0} do
        simOMPL.setStartState(t, {-0.5, 0})
        simOMPL.setup(t)
        print(type(simOMPL.solve(t, time)))
    end
end

function sysCall_init()
    robot = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 1, 1})
    space = simOMPL.createStateSpace('p', T.position2d, robot, {-1, -1}, {1, 1}, 1)
    open()
    everyPlanner()
    callbacks()
    dummies()
    again()
end
