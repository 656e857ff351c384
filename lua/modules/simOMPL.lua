--[[
Motion planning for objects and joints of the scene: tasks, state spaces, planners.

Planning is native; here are helpers for joints, paths and drawings.
]]

local _, simOMPL = ...

local sim = require 'sim'
local check = require 'checkargs.check'

local GREY <const> = {0.5, 0.5, 0.5}

---------------------------------------------------------------- state spaces and goals

local JOINT_ARGS = {{type = 'string'}, {type = 'handle'}, {type = 'int', default = 0}, {type = 'float', default = 1}}
local JOINTS_ARGS = {
    {type = 'string'}, {type = 'table', item_type = 'handle'}, {type = 'table', default = {}}, {type = 'table', default = {}},
}
local STATES_ARGS = {{type = 'string'}, {type = 'table', size = '1..*'}}

--- A state space for a joint, with the limits that it has.
-- @api string ssHandle = simOMPL.createStateSpaceForJoint(string name, int jointHandle, int useForProjection = 0, float weight = 1)
-- @param name for simOMPL.printTaskInfo
-- @param jointHandle the joint
-- @param useForProjection 1: the first state space of a task that has it is its projection
-- @param weight factor of its distances
-- @return ssHandle ends with the script
function simOMPL.createStateSpaceForJoint(...)
    local name, joint, useForProjection, weight = check(JOINT_ARGS, ...)
    local cyclic, interval = sim.getJointInterval(joint)
    local kind, low, high = simOMPL.StateSpaceType.joint_position, {interval[1]}, {interval[1] + interval[2]}
    if cyclic then kind, low, high = simOMPL.StateSpaceType.cyclic_joint_position, {}, {} end
    return simOMPL.createStateSpace(name, kind, joint, low, high, useForProjection, weight)
end

--- The positions of joints as the states of a task.
-- @api simOMPL.setStateSpaceForJoints(string taskHandle, int[] jointHandles, int[] useForProjection = {}, float[] weight = {})
-- @param taskHandle the task
-- @param jointHandles the joints
-- @param useForProjection of each joint: 1 for the one that is the projection
-- @param weight of each joint: factors of distances
function simOMPL.setStateSpaceForJoints(...)
    local task, joints, useForProjection, weights = check(JOINTS_ARGS, ...)
    local spaces = {}
    for i, joint in ipairs(joints) do
        spaces[i] = simOMPL.createStateSpaceForJoint('joint' .. i, joint, useForProjection[i], weights[i])
    end
    simOMPL.setStateSpace(task, spaces)
end

--- Sets the states in which paths may end, instead of all goals so far.
-- @api simOMPL.setGoalStates(string taskHandle, any[] states)
-- @param taskHandle the task
-- @param states a list of numbers for each
function simOMPL.setGoalStates(...)
    local task, states = check(STATES_ARGS, ...)
    simOMPL.setGoalState(task, states[1])
    for i = 2, #states do simOMPL.addGoalState(task, states[i]) end
end

---------------------------------------------------------------- paths

local PATH_ARGS = {{type = 'string'}, {type = 'table', item_type = 'float'}}
local STATE_ARGS = {{type = 'string'}, {type = 'table', item_type = 'float'}, {type = 'int'}}
local TASK_ARGS = {{type = 'string'}}

--- Number of states of a path.
-- @api float count = simOMPL.getPathStateCount(string taskHandle, float[] path)
-- @param taskHandle the task
-- @param path flat list
-- @return count with a fraction where numbers are missing
function simOMPL.getPathStateCount(...)
    local task, path = check(PATH_ARGS, ...)
    return #path / simOMPL.getStateSpaceDimension(task)
end

-- The i-th of the lists of n numbers in a flat list.
local function piece(list, n, i) return table.move(list, (i - 1) * n + 1, i * n, 1, {}) end

--- A state of a path.
-- @api float[] state = simOMPL.getPathState(string taskHandle, float[] path, int index)
-- @param taskHandle the task
-- @param path flat list
-- @param index 1 for the first, -1 for the last
-- @return state empty where there is none
function simOMPL.getPathState(...)
    local task, path, index = check(STATE_ARGS, ...)
    if index == 0 then error('invalid index', 2) end
    local n = simOMPL.getStateSpaceDimension(task)
    if n == 0 then return {} end
    if index < 0 then index = #path // n + index + 1 end
    if index < 1 or index > #path // n then return {} end
    return piece(path, n, index)
end

--- A path from its end to its beginning.
-- @api float[] reversedPath = simOMPL.getReversedPath(string taskHandle, float[] path)
-- @param taskHandle the task
-- @param path flat list
-- @return reversedPath flat list
function simOMPL.getReversedPath(...)
    local task, path = check(PATH_ARGS, ...)
    local n, reversed = simOMPL.getStateSpaceDimension(task), {}
    if n == 0 then return reversed end
    for i = #path // n, 1, -1 do table.move(path, (i - 1) * n + 1, i * n, #reversed + 1, reversed) end
    return reversed
end

--- Numbers of a projected state.
-- @api int size = simOMPL.projectionSize(string taskHandle)
-- @param taskHandle the task
-- @return size
function simOMPL.projectionSize(...)
    local task = check(TASK_ARGS, ...)
    return #simOMPL.projectStates(task, simOMPL.readState(task))
end

--- Length of a path in its projection.
-- @api float length = simOMPL.getProjectedPathLength(string taskHandle, float[] path)
-- @param taskHandle the task
-- @param path flat list
-- @return length
function simOMPL.getProjectedPathLength(...)
    local task, path = check(PATH_ARGS, ...)
    local n, points = simOMPL.projectionSize(task), simOMPL.projectStates(task, path)
    local length = 0.0
    for i = n + 1, n > 0 and #points or 0, n do
        local square = 0
        for j = i, i + n - 1 do square = square + (points[j] - points[j - n]) ^ 2 end
        length = length + math.sqrt(square)
    end
    return length
end

---------------------------------------------------------------- drawings

local DRAW_PATH_ARGS = {
    {type = 'string'}, {type = 'table', item_type = 'float'}, {type = 'float', default = 2},
    {type = 'table', item_type = 'float', size = '3..*', default = {1, 0, 0}}, {type = 'int', default = 0},
}
local COLOUR = {type = 'table', item_type = 'float', size = '3..*', default = GREY}
local DRAW_DATA_ARGS = {
    {type = 'string'}, {type = 'float', default = 0.02}, {type = 'float', default = 2}, COLOUR, COLOUR, COLOUR,
}
local REMOVE_ARGS = {{type = 'string'}, {type = 'table', item_type = 'handle'}}

local function requireSpace(task)
    if simOMPL.projectionSize(task) ~= 3 then
        error('this functions works only with 3D projections: use three numbers, such as those of position3d, for the projection', 3)
    end
end

-- Until it is closed, the thread is not interrupted: nobody sees half a drawing.
local function inOnePiece()
    local before = sim.setStepping(true)
    return setmetatable({}, {__close = function() sim.setStepping(before) end})
end

local function drawing(kind, size, colour, points, attributes)
    local count = math.max(1, #points // 3)
    local object = sim.addDrawingObject(kind + (attributes or 0), size, 0, -1, count, colour)
    local width = kind == sim.drawing_lines and 6 or 3
    for i = 1, #points, width do sim.addDrawingObjectItem(object, table.move(points, i, i + width - 1, 1, {})) end
    return object
end

--- Draws a path of which the projection is a position.
-- @api int[] dwos = simOMPL.drawPath(string taskHandle, float[] path, float lineSize = 2, float[3] color = {1, 0, 0}, int extraAttributes = 0)
-- @param taskHandle the task
-- @param path flat list
-- @param lineSize pixels
-- @param color red, green, blue
-- @param extraAttributes added to sim.drawing_lines
-- @return dwos drawing objects
function simOMPL.drawPath(...)
    local task, path, lineSize, color, extra = check(DRAW_PATH_ARGS, ...)
    requireSpace(task)
    local ending <close> = inOnePiece()
    local points, lines = simOMPL.projectStates(task, path), {}
    for i = 4, #points, 3 do table.move(points, i - 3, i + 2, #lines + 1, lines) end
    return {drawing(sim.drawing_lines, lineSize, color, lines, extra)}
end

--- Draws what a planner has found out, of which the projection is a position.
-- @api int[] dwos = simOMPL.drawPlannerData(string taskHandle, float pointSize = 0.02, float lineSize = 2, float[3] color = {0.5, 0.5, 0.5}, float[3] startColor = {0.5, 0.5, 0.5}, float[3] goalColor = {0.5, 0.5, 0.5})
-- @param taskHandle the task
-- @param pointSize metres
-- @param lineSize pixels
-- @param color of states and motions
-- @param startColor of starts
-- @param goalColor of goals
-- @return dwos drawing objects: states, starts, goals, motions
function simOMPL.drawPlannerData(...)
    local task, pointSize, lineSize, color, startColor, goalColor = check(DRAW_DATA_ARGS, ...)
    requireSpace(task)
    local ending <close> = inOnePiece()
    local states, _, _, edges, _, starts, goals = simOMPL.getPlannerData(task)
    local points = simOMPL.projectStates(task, states)
    local function at(places)
        local list = {}
        for _, place in ipairs(places) do table.move(points, 3 * place + 1, 3 * place + 3, #list + 1, list) end
        return list
    end
    return {
        drawing(sim.drawing_spherepts, pointSize, color, points),
        drawing(sim.drawing_spherepts, pointSize, startColor, at(starts)),
        drawing(sim.drawing_spherepts, pointSize, goalColor, at(goals)),
        drawing(sim.drawing_lines, lineSize, color, at(edges)),
    }
end

--- Removes drawings.
-- @api simOMPL.removeDrawingObjects(string taskHandle, int[] dwos)
-- @param taskHandle the task
-- @param dwos drawing objects
function simOMPL.removeDrawingObjects(...)
    local _, objects = check(REMOVE_ARGS, ...)
    for _, object in ipairs(objects) do sim.removeDrawingObject(object) end
end

return simOMPL
