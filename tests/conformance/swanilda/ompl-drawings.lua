-- topic: planning
-- spec: simompl 7, simompl 8; drawings of paths and of what planners know, reports
-- as: simulation
-- passes: 1
sim = require 'sim'
local simOMPL = require 'simOMPL'

local function fails(f, ...)
    local fine, message = pcall(f, ...)
    return fine and 'no error' or (message:gsub('^.*in simOMPL%.[%w_]+: ', ''):gsub('^.-:%d+: ', ''))
end

local function task(name, kind, low, high, start, goal)
    local t = simOMPL.createTask(name)
    simOMPL.setStateSpace(t, {simOMPL.createStateSpace(name .. ' space', kind, sim.createDummy(0.01), low, high, 1)})
    simOMPL.setAlgorithm(t, simOMPL.Algorithm.RRTConnect)
    simOMPL.setStartState(t, start)
    simOMPL.setGoalState(t, goal)
    simOMPL.setup(t)
    return t
end

local function isRemoved(object) return not pcall(sim.addDrawingObjectItem, object, {0, 0, 0}) end

function sysCall_init()
    local T <const> = simOMPL.StateSpaceType
    local t = task('flight', T.position3d, {-1, -1, -1}, {1, 1, 1}, {-0.5, 0, 0}, {0.5, 0, 0.5})
    simOMPL.setVerboseLevel(t, 2)
    simOMPL.compute(t, 1, -1, 3)
    local path = simOMPL.getPath(t)
    local lines, data = simOMPL.drawPath(t, path), simOMPL.drawPlannerData(t)
    print(#lines, #data, simOMPL.projectionSize(t))
    simOMPL.removeDrawingObjects(t, lines)
    print('removed', isRemoved(lines[1]), isRemoved(data[1]), isRemoved(data[4]))
    simOMPL.removeDrawingObjects(t, data)
    print('removed', isRemoved(data[1]), isRemoved(data[4]))
    print('drawn again', #simOMPL.drawPath(t, path, 3, {0, 1, 0}, sim.drawing_cyclic), #simOMPL.drawPlannerData(t, 0.01, 1, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}))
    print('of nothing', #simOMPL.drawPath(t, {}), fails(simOMPL.drawPath, t, 'x'), fails(simOMPL.drawPath, t, path, 2, {1}))
    print(fails(simOMPL.drawPath, t, {0, 0}))
    local flat = task('walk', T.position2d, {-1, -1}, {1, 1}, {-0.5, 0}, {0.5, 0})
    print(fails(simOMPL.drawPath, flat, {0, 0}):match('^this functions works only with 3D projections'), fails(simOMPL.drawPlannerData, flat):match('3D'))
    simOMPL.setStateValidationCallback(flat, function() return false end)
    simOMPL.setVerboseLevel(flat, 1)
    print(simOMPL.solve(flat, 1))
    simOMPL.setGoalCallback(flat, 'isThere')
    simOMPL.setCollisionPairs(flat, {1, 2})
    simOMPL.printTaskInfo(flat)
    local dummies = simOMPL.createTask('meeting')
    simOMPL.setGoal(dummies, 1, 2)
    simOMPL.setAlgorithm(dummies, 7)
    simOMPL.printTaskInfo(dummies)
end
