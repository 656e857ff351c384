-- topic: planning
-- spec: simompl 1, simompl 2, simompl 4, simompl 6; objects, sizes, distances, bounds
-- tol: 1e-9
-- as: simulation
-- passes: 1
sim = require 'sim'
local simOMPL = require 'simOMPL'
local T <const> = simOMPL.StateSpaceType

local function fails(f, ...)
    local fine, message = pcall(f, ...)
    if fine then return 'no error' end
    return (message:gsub('^.*in simOMPL%.[%w_]+: ', ''))
end

local function task(spaces, start, goal)
    local t = simOMPL.createTask('t')
    simOMPL.setStateSpace(t, spaces)
    if start then simOMPL.setStartState(t, start) end
    if goal then simOMPL.setGoalState(t, goal) end
    return t
end

local function ready(space, start)
    local t = task({space}, start, start)
    simOMPL.setup(t)
    return t
end

function sysCall_init()
    local D = sim.createDummy(0.01)
    local function space(kind, low, high, weight) return simOMPL.createStateSpace('a', kind, D, low, high, 1, weight) end
    print(fails(simOMPL.createStateSpace, 'a', T.position2d, D, {0, 0}, {1}, 1))
    for _, weight in ipairs{0, -1, 0 / 0, math.huge} do print(fails(space, T.position2d, {0, 0}, {1, 1}, weight)) end
    print(fails(simOMPL.createStateSpace, 'a', T.position2d, D, {0, 0}, {1, 1}, 1, 1, 99999))
    print(fails(simOMPL.createStateSpace, 'a'), fails(simOMPL.createTask))

    local plane = space(T.position2d, {-1, -1}, {1, 1})
    print(plane:match('^%x+:OMPL%.StateSpace$') == plane)
    local empty = simOMPL.createTask('empty')
    print(empty:match('^%x+:OMPL%.Task$') == empty, simOMPL.getStateSpaceDimension(empty))
    print(fails(simOMPL.setStartState, empty, {0, 0, 0}), fails(simOMPL.setStartState, empty, {}))
    print(fails(simOMPL.setup, empty))
    local P = task{plane}
    print(fails(simOMPL.setStartState, P, {0, 0, 0}), fails(simOMPL.addGoalState, P, {0}), fails(simOMPL.setGoalState, P, {}))
    local state = {0, 0}
    for name, arguments in pairs{solve = {1}, compute = {1}, simplifyPath = {}, interpolatePath = {}, hasSolution = {}, hasExactSolution = {}, hasApproximateSolution = {},
        getGoalDistance = {}, getPath = {}, getPlannerData = {}, readState = {}, writeState = {state}, isStateValid = {state}, isStateWithinBounds = {state}, enforceBounds = {state},
        stateDistance = {state, state}, projectStates = {state}} do
        local message = fails(simOMPL[name], P, table.unpack(arguments))
        if message ~= 'simOMPL.setup(taskHandle) has not been called' then print(name, message) end
    end
    print(fails(simOMPL.setup, P))
    simOMPL.setStartState(P, {0, 0})
    print(fails(simOMPL.setup, P))
    simOMPL.addGoalState(P, {0.5, 0})
    simOMPL.setAlgorithm(P, 5)
    print(fails(simOMPL.setup, P))
    simOMPL.setAlgorithm(P, simOMPL.Algorithm.RRT)
    for _, resolution in ipairs{0, 1, -0.5, 0 / 0} do
        simOMPL.setStateValidityCheckingResolution(P, resolution)
        print(fails(simOMPL.setup, P))
    end
    simOMPL.setStateValidityCheckingResolution(P, 0.01)
    simOMPL.setup(P)
    print(fails(simOMPL.getPath, P), fails(simOMPL.interpolatePath, P), fails(simOMPL.simplifyPath, P), simOMPL.getGoalDistance(P), simOMPL.hasSolution(P))
    print(fails(simOMPL.setStateSpace, P, {'nothing'}), simOMPL.getStateSpaceDimension(P))

    for _, bounds in ipairs{{{0, 0, 0}, {1, 1, 1}}, {{0, 1}, {1, 0}}, {{0 / 0, 0}, {1, 1}}, {{0, 0}, {math.huge, 1}}, {{}, {}}} do
        print(fails(simOMPL.setup, task({space(T.position2d, bounds[1], bounds[2])}, {0, 0}, {0, 0})))
    end
    simOMPL.setup(task({space(T.position2d, {0, 0}, {0, 0})}, {0, 0}, {0, 0}))
    print(fails(simOMPL.setup, task({space(T.position2d, {0, 0}, {1, 1}), space(7, {}, {})}, {0, 0}, {0, 0})))
    local joint, cyclic = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0), sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    local compound = task{space(T.pose3d, {0, 0, 0}, {1, 1, 1}), simOMPL.createStateSpaceForJoint('j', joint), simOMPL.createStateSpaceForJoint('c', cyclic, 1, 2)}
    print(simOMPL.getStateSpaceDimension(compound))

    local weighted = ready(space(T.position2d, {-1, -1}, {1, 1}, 2), {0, 0})
    print(simOMPL.stateDistance(weighted, {0, 0}, {0.3, 0.4}))
    print(simOMPL.stateDistance(ready(space(T.pose2d, {-5, -5}, {5, 5}), {0, 0, 0}), {0, 0, 3}, {3, 4, -3}))
    local half = math.sqrt(0.5)
    print(simOMPL.stateDistance(ready(space(T.pose3d, {-1, -1, -1}, {1, 1, 1}), {0, 0, 0, 0, 0, 0, 1}), {0, 0, 0, 0, 0, 0, 1}, {0, 0, 0, 0, 0, half, half}))
    local car = space(T.dubins, {-2, -2}, {2, 2})
    local drive = ready(car, {0, 0, 0})
    print(simOMPL.stateDistance(drive, {0, 0, 0}, {1, 0, 0}), simOMPL.stateDistance(drive, {0, 0, 0}, {0, 0.1, math.pi}), simOMPL.stateDistance(drive, {0, 0, 0}, {-1, 0, 0}))
    simOMPL.setDubinsParams(car, 0.05, true)
    print(simOMPL.stateDistance(drive, {0, 0, 0}, {-1, 0, 0}))
    simOMPL.setup(drive)
    print(simOMPL.stateDistance(drive, {0, 0, 0}, {-1, 0, 0}), fails(simOMPL.setDubinsParams, car, 0, true))
    local turn = ready(simOMPL.createStateSpaceForJoint('c', cyclic, 1), {0})
    print(simOMPL.isStateWithinBounds(turn, {math.pi}), simOMPL.isStateWithinBounds(turn, {-math.pi}), simOMPL.enforceBounds(turn, {4}))
    print(simOMPL.enforceBounds(P, {2, -3}), simOMPL.isStateWithinBounds(P, {1, 1}), simOMPL.isStateWithinBounds(P, {0 / 0, 1}), simOMPL.isStateValid(P, {0 / 0, 1}))
    print(simOMPL.projectStates(P, {0.1, 0.2, 0.3, 0.4}), simOMPL.projectionSize(P), fails(simOMPL.projectStates, P, {1, 2, 3}))

    sim.setObjectPosition(D, {0.2, 0.3, 0.7})
    print(simOMPL.readState(P))
    simOMPL.writeState(P, {0.5, 0.6})
    print(sim.getObjectPosition(D))
    print(fails(simOMPL.writeState, P, {0 / 0, 0}), fails(simOMPL.writeState, P, {1}))
    local path = {1, 2, 3, 4, 5, 6}
    print(simOMPL.getPathState(P, path, -1), simOMPL.getPathState(P, path, 1), simOMPL.getPathState(P, path, 9), simOMPL.getReversedPath(P, path), simOMPL.getPathStateCount(P, path))
    print(fails(simOMPL.getPathState, P, path, 0):match('invalid index'), simOMPL.getProjectedPathLength(P, path))

    print(fails(simOMPL.setGoalCallback, P, ''), fails(simOMPL.setValidStateSamplerCallback, P, '', ''), fails(simOMPL.setProjectionEvaluationCallback, P, 'f', 0))
    simOMPL.destroyStateSpace(plane)
    print(fails(simOMPL.readState, P), fails(simOMPL.setup, P), fails(simOMPL.destroyStateSpace, plane))
    simOMPL.destroyTask(P)
    print(fails(simOMPL.setup, P), fails(simOMPL.destroyTask, P), fails(simOMPL.solve, plane, 1), fails(simOMPL.solve, 'x', 1))
end
