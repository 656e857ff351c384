--[[
sim.createPath, and configurations of joints.

Path objects are defined in swanilda/pathmodel.lua.
]]

local sim = ...
local M = {}
local MAX_ALTERNATIVES <const> = 10000
local MAX_POINTS <const> = 100000 -- beyond, a mistyped number would keep the script busy for minutes

-- A tail call: its own frame is gone when checkargs looks for the checked function.
local function check(types, ...) return require('checkargs.check').checkargsEx({level = 0}, types, ...) end

local CREATE_ARGS = {
    {type = 'table', item_type = 'float', size = '14..*'}, {type = 'int', default = 0}, {type = 'int', default = 100},
    {type = 'float', default = 1.0}, {type = 'int', default = 0},
    {type = 'table', item_type = 'float', size = 3, default = {0, 0, 1}},
}

--- Creates a path object from control points.
-- @api int pathHandle = sim.createPath(float[] ctrlPts, int options = 0, int subdiv = 100, float smoothness = 1.0, int orientationMode = 0, float[3] upVector = {0, 0, 1})
-- @param ctrlPts poses, seven numbers each, at least two
-- @param options 1 hidden while a simulation runs, 2 closed, 4 a shape along it, 16 orientation computed from the direction
-- @param subdiv number of points of the sampled path
-- @param smoothness strength of the rounded corners, 0 to 1
-- @param orientationMode axes along the path and up: 0 xy, 1 xz, 2 yx, 3 yz, 4 zx, 5 zy
-- @param upVector what is up when the orientation is computed
-- @return pathHandle a dummy, with custom data PATHCTRLPTS and PATH (seven doubles per point); dummies below it are the control points
--
-- With a number first it is a path object of V-REP: attributes, integer parameters, floating-point parameters, colours.
function M.createPath(...)
    if type((...)) == 'number' then return sim._createPathObject(...) end
    local ctrlPts, options, subdiv, smoothness, mode, up = check(CREATE_ARGS, ...)
    if subdiv < 2 then error('subdiv has to be 2 at least.', 2) end
    if subdiv > MAX_POINTS then error('subdiv has to be ' .. MAX_POINTS .. ' at most.', 2) end
    local model = require 'swanilda.pathmodel'
    local path = model.create(ctrlPts, {
        bitCoded = options, pointCnt = subdiv, smoothing = smoothness, autoOrientation = mode, upVector = up,
    })
    model.addShape(path)
    return path
end

local function turnsWithin(position, low, range)
    local values, turn = {}, 2 * math.pi
    local value = position - turn * math.floor((position - low) / turn)
    while value <= low + range do
        values[#values + 1] = value
        value = value + turn
    end
    return values
end

local function alternatives(joint, position, low, range)
    if sim.getJointType(joint) ~= sim.joint_revolute then return {position} end
    local cyclic, interval = sim.getJointInterval(joint)
    if cyclic and not range then return {position} end
    low, range = low or interval[1], range or interval[2]
    if range <= 2 * math.pi then return {position} end
    local values = turnsWithin(position, low, range)
    return #values > 0 and values or {position}
end

local ALTERNATE_ARGS = {
    {type = 'table', item_type = 'int'}, {type = 'table', item_type = 'float'}, {type = 'int', default = -1},
    {type = 'table', item_type = 'float', nullable = true}, {type = 'table', item_type = 'float', nullable = true},
}

--- Configurations that put the same robot in the same place: full turns added where the joints allow them.
-- @api float[] configs = sim.getAlternateConfigs(int[] joints, float[] config, int tip = -1, float[] lowLimits = nil, float[] ranges = nil)
-- @param joints handles
-- @param config their positions
-- @param tip ignored
-- @param lowLimits instead of those of the joints
-- @param ranges instead of those of the joints
-- @return configs flat table, the given one among them
function M.getAlternateConfigs(...)
    local joints, config, _, lowLimits, ranges = check(ALTERNATE_ARGS, ...)
    local configs = {{}}
    for i, joint in ipairs(joints) do
        local extended = {}
        local values = alternatives(joint, config[i], lowLimits and lowLimits[i], ranges and ranges[i])
        for _, partial in ipairs(configs) do
            for _, value in ipairs(values) do
                if #extended == MAX_ALTERNATIVES then break end
                local longer = table.move(partial, 1, i - 1, 1, {})
                longer[i] = value
                extended[#extended + 1] = longer
            end
        end
        configs = extended
    end
    local result = {}
    for _, one in ipairs(configs) do table.move(one, 1, #one, #result + 1, result) end
    return result
end

return M
