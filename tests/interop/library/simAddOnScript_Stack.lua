-- An add-on of the kind that research programs put into the folder of the library, with functions for them.

-- Each list with its items doubled; bytes as they are.
function twice(integers, floats, texts, bytes)
    for list, double in pairs {
        [integers] = function(item) return 2 * item end,
        [floats] = function(item) return 2 * item end,
        [texts] = function(item) return item .. item end,
    } do
        for place, item in ipairs(list) do list[place] = double(item) end
    end
    return integers, floats, texts, bytes
end

-- A path of a shape in the plane from x = -1 to x = 1.
function plan(integers, floats, texts, bytes)
    local task = simOMPL.createTask('plan')
    local space = simOMPL.createStateSpace('plane', simOMPL.StateSpaceType.position2d, integers[1], {-2, -2}, {2, 2}, 1)
    simOMPL.setStateSpace(task, {space})
    simOMPL.setAlgorithm(task, simOMPL.Algorithm.RRTConnect)
    simOMPL.setStartState(task, {-1, 0})
    simOMPL.setGoalState(task, {1, 0})
    local solved, path = simOMPL.compute(task, 4, -1, 20)
    simOMPL.destroyTask(task)
    assert(solved and simVision.handleSpherical)
    return {}, path, {}, ''
end
