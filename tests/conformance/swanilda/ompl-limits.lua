-- topic: planning
-- spec: simompl 2, simompl 4, simompl 6, simompl 7; numbers that are none, goals that cannot be reached, objects and tasks that go while they are used; nothing hangs
-- as: simulation
-- passes: 1
sim = require 'sim'
local simOMPL = require 'simOMPL'
local T <const>, A <const> = simOMPL.StateSpaceType, simOMPL.Algorithm
local NAN <const>, INF <const> = 0 / 0, math.huge

local function fails(f, ...)
    local fine, message = pcall(f, ...)
    return fine and 'no error' or (message:gsub('^.*in simOMPL%.[%w_]+: ', ''))
end

local names = {}
for name in pairs(A) do names[#names + 1] = name end
table.sort(names)

local function space(kind, low, high, object) return simOMPL.createStateSpace('s', kind, object or robot, low, high, 1) end

local function task(planner, spaces, start, goal)
    local t = simOMPL.createTask('t')
    simOMPL.setStateSpace(t, spaces or {plane})
    simOMPL.setAlgorithm(t, A[planner])
    simOMPL.setStartState(t, start or {-0.5, 0})
    simOMPL.setGoalState(t, goal or {0.5, 0})
    return t
end

-- What a planner answers; the states of its path, if it has one, are finite.
local function solve(t, time)
    local message = fails(simOMPL.setup, t)
    if message ~= 'no error' then return message end
    message = fails(simOMPL.solve, t, time)
    if message ~= 'no error' then return message end
    if not simOMPL.hasSolution(t) then return 'none' end
    simOMPL.simplifyPath(t, 0.1)
    simOMPL.interpolatePath(t, 20)
    for _, x in ipairs(simOMPL.getPath(t)) do
        if x ~= x or math.abs(x) == INF then return 'a path of what is no number' end
    end
    return simOMPL.hasExactSolution(t) and 'exact' or 'near'
end

-- What all planners answer, except for what is expected: a set of answers, of which it depends on the time which one comes.
local function everybody(what, expected, prepare, time)
    local others = {}
    for _, name in ipairs(names) do
        local answer = solve(prepare(name), time)
        if not expected[answer] then others[#others + 1] = name .. ': ' .. answer end
    end
    print(what, #others == 0 and 'as expected' or table.concat(others, '; '))
end

local NO_PATH <const>, NOT_EXACT <const> = {none = true}, {none = true, near = true}
local EXACT <const>, ANY <const> = {exact = true}, {none = true, near = true, exact = true}

local function unreachable()
    everybody('walled in', NOT_EXACT, function(name)
        local t = task(name)
        -- A ring around the goal.
        simOMPL.setStateValidationCallback(t, function(s)
            local distance = math.sqrt((s[1] - 0.5) ^ 2 + s[2] ^ 2)
            return distance < 0.1 or distance > 0.2
        end)
        return t
    end, 0.02)
    everybody('nothing is valid but the ends', NOT_EXACT, function(name)
        local t = task(name)
        simOMPL.setStateValidationCallback(t, function(s) return s[2] == 0 and math.abs(s[1]) == 0.5 end)
        return t
    end, 0.02)
    everybody('a start that is no number', NO_PATH, function(name) return task(name, nil, {NAN, 0}) end, 0.1)
    everybody('an endless goal', NOT_EXACT, function(name) return task(name, nil, nil, {INF, 0}) end, 0.1)
    everybody('bounds of one point', EXACT, function(name) return task(name, {space(T.position2d, {0, 0}, {0, 0})}, {0, 0}, {0, 0}) end, 0.02)
    everybody('huge bounds', ANY, function(name) return task(name, {space(T.position2d, {-1e308, -1e308}, {1e308, 1e308})}) end, 0.02)
    everybody('tiny bounds', ANY, function(name) return task(name, {space(T.position2d, {0, 0}, {1e-300, 1e-300})}, {0, 0}, {1e-300, 0}) end, 0.02)
    everybody('fine checks', NOT_EXACT, function(name)
        local t = task(name)
        simOMPL.setStateValidityCheckingResolution(t, 1e-300)
        return t
    end, 0.02)
    for _, time in ipairs{0, -1, NAN} do
        everybody('no time', NOT_EXACT, function(name)
            local t = task(name)
            simOMPL.setStateValidationCallback(t, function(s) return math.abs(s[1]) > 0.2 end)
            return t
        end, time)
    end
end

-- 20000 checks stand for a second.
local function bounded()
    local worst = 0
    for _, name in ipairs(names) do
        local t, calls = task(name), 0
        simOMPL.setStateValidationCallback(t, function(s)
            calls = calls + 1
            return math.abs(s[1]) > 0.2
        end)
        simOMPL.setup(t)
        simOMPL.solve(t, 0.1)
        worst = math.max(worst, calls)
        if calls < 50 then print(name, calls) end
    end
    print('checks', worst <= 2000)
end

local function callbacks()
    for what, number in ipairs{NAN, INF, -INF, 1e300} do
        everybody('projection ' .. what, ANY, function(name)
            local t = task(name)
            simOMPL.setProjectionEvaluationCallback(t, function() return {number} end, 1)
            return t
        end, 0.02)
    end
    everybody('samples that are no numbers', NOT_EXACT, function(name)
        local t = task(name)
        simOMPL.setStateValidationCallback(t, function(s) return math.abs(s[1]) > 0.2 end)
        simOMPL.setValidStateSamplerCallback(t, function() return {NAN, NAN} end, function() return {INF, NAN} end)
        return t
    end, 0.02)
    everybody('a goal at no distance', NOT_EXACT, function(name)
        local t = task(name)
        simOMPL.setGoalCallback(t, function() return false, NAN end)
        return t
    end, 0.02)
    local long = task('RRT')
    simOMPL.setValidStateSamplerCallback(long, function() return {1} end, function() return {1} end)
    simOMPL.setAlgorithm(long, A.PRM)
    simOMPL.setStateValidationCallback(long, function(s) return math.abs(s[1]) > 0.2 end)
    print('a sample that is too short', solve(long, 0.1))
end

-- Callbacks that take away what the planner works with.
local function sabotage()
    local function planned(act)
        local other, done = sim.createDummy(0.01), false
        local own = space(T.position2d, {-1, -1}, {1, 1}, other)
        local t = task('KPIECE1', {own})
        simOMPL.setStateValidationCallback(t, function(s)
            if not done then
                done = true
                act(t, own, other)
            end
            return math.abs(s[1]) > 0.2 or s[2] > 0.9
        end)
        simOMPL.setup(t)
        return fails(simOMPL.solve, t, 0.2), fails(simOMPL.getPath, t)
    end
    print('the task goes', planned(function(t) simOMPL.destroyTask(t) end))
    print('the space goes', planned(function(_, own) simOMPL.destroyStateSpace(own) end))
    print('the object goes', planned(function(_, _, other) sim.removeObjects{other} end))
    print('a new setup', (planned(function(t) simOMPL.setup(t) end)))
    print('another callback', (planned(function(t) simOMPL.setStateValidationCallback(t, '') end)))
    print('another start', (planned(function(t) simOMPL.setStartState(t, {0.3, 0}) end)))
    print('other spaces', (planned(function(t) simOMPL.setStateSpace(t, {plane, plane}) end)))
    local moving, still = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}), sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 1, 0.1})
    local t = task('RRTConnect', {space(T.position2d, {-1, -1}, {1, 1}, moving)})
    simOMPL.setCollisionPairs(t, {moving, still})
    simOMPL.setup(t)
    print('before', simOMPL.isStateValid(t, {0, 0}), simOMPL.isStateValid(t, {0.5, 0}))
    sim.removeObjects{moving}
    print('without its object', fails(simOMPL.isStateValid, t, {0, 0}), fails(simOMPL.solve, t, 0.1), fails(simOMPL.readState, t))
    t = task('RRTConnect', {space(T.joint_position, {-1}, {1}, still)}, {0}, {1})
    simOMPL.setCollisionPairs(t, {still, sim.handle_all})
    simOMPL.setup(t)
    print('no joint', fails(simOMPL.isStateValid, t, {0}), fails(simOMPL.writeState, t, {0}), fails(simOMPL.solve, t, 0.1))
    sim.removeObjects{still}
end

local function arguments()
    local t = simOMPL.createTask('odd')
    print(fails(simOMPL.setStateSpace, t, {}), fails(simOMPL.setup, t), fails(simOMPL.setStateSpace, t, {'x'}), fails(simOMPL.setStateSpace, t, {1}))
    simOMPL.setStateSpace(t, {plane, plane})
    print('twice the same', simOMPL.getStateSpaceDimension(t), fails(simOMPL.setStartState, t, {0, 0, 0, 0}))
    print(fails(simOMPL.setGoal, t, 123456, -1, NAN, {NAN, INF, 0, 0}), fails(simOMPL.setup, t), fails(simOMPL.solve, t, 0.1))
    simOMPL.setCollisionPairs(t, {NAN, 1, 2})
    t = task('RRTConnect')
    simOMPL.setup(t)
    simOMPL.solve(t, 1)
    for _, time in ipairs{0, NAN, INF, -INF} do simOMPL.simplifyPath(t, time) end
    for _, count in ipairs{-5, 0, 1, 2.7} do simOMPL.interpolatePath(t, count) end
    print('still a path', fails(simOMPL.interpolatePath, t, INF), #simOMPL.getPath(t) > 4)
    print(fails(simOMPL.setAlgorithm, t, NAN), fails(simOMPL.setup, t))
    simOMPL.setStateSpace(t, {space(T.pose2d, {-INF, 0}, {INF, 1})})
    simOMPL.setStartState(t, {0, 0, 0})
    simOMPL.setGoalState(t, {0, 0, 0})
    print(fails(simOMPL.setup, t))
    t = task('RRT', {space(T.pose3d, {-1, -1, -1}, {1, 1, 1})}, {0, 0, 0, 0, 0, 0, 1}, {0, 0, 0, 0, 0, 0, 0})
    print('no rotation', solve(t, 0.1), fails(simOMPL.writeState, t, {0, 0, 0, 0, 0, 0, 0}), simOMPL.enforceBounds(t, {9, 0, 0, 0, 0, 0, 0}))
end

function sysCall_init()
    -- What planners refuse is printed, not logged.
    sim.setInt32Param(sim.intparam_verbosity, sim.verbosity_none)
    robot = sim.createDummy(0.01)
    plane = space(T.position2d, {-1, -1}, {1, 1})
    unreachable()
    bounded()
    callbacks()
    sabotage()
    arguments()
end
