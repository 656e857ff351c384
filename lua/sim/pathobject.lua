--[[
Path objects (a dummy that carries control points and a sampled path as custom data), and configurations of joints.

Does not draw a path nor give it the script that would do so.
]]

local sim = ...
local M = {}
local quaternion = require 'quaternion'

local CLOSED <const>, COMPUTE_ORIENTATION <const> = 2, 16 -- the other options are about what is drawn
local TYPES <const> = {0, 0, 0, 2, 2, 2, 2}
local MAX_ALTERNATIVES <const> = 10000

-- A tail call: its own frame is gone when checkargs looks for the checked function.
local function check(types, ...) return require('checkargs').checkargsEx({level = 0}, types, ...) end

local function normalized(v)
    local norm = math.sqrt(v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2)
    return norm > 1e-12 and {v[1] / norm, v[2] / norm, v[3] / norm} or nil
end

local function cross(a, b)
    return {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]}
end

-- Which axes point along the path and up, by orientation mode.
local AXES <const> = {[0] = {'x', 'y'}, {'x', 'z'}, {'y', 'x'}, {'y', 'z'}, {'z', 'x'}, {'z', 'y'}}

local function orientationAlong(direction, up, mode)
    local along = normalized(direction)
    local side = along and normalized(cross(up, along))
    if not side then return nil end
    local axes, names = {}, AXES[mode] or AXES[0]
    axes[names[1]], axes[names[2]] = along, cross(along, side)
    axes.x = axes.x or cross(axes.y, axes.z)
    axes.y = axes.y or cross(axes.z, axes.x)
    axes.z = axes.z or cross(axes.x, axes.y)
    return quaternion.fromAxes(axes.x, axes.y, axes.z)
end

local function orientAlongPath(path, closed, up, mode)
    local count = #path // 7
    local function position(i)
        i = closed and (i - 1) % count + 1 or math.max(1, math.min(count, i))
        return path[7 * i - 6], path[7 * i - 5], path[7 * i - 4]
    end
    for i = 1, count do
        local ax, ay, az = position(i - 1)
        local bx, by, bz = position(i + 1)
        local q = orientationAlong({bx - ax, by - ay, bz - az}, up, mode)
        if q then table.move(q, 1, 4, 7 * i - 3, path) end
    end
end

local function samplePath(ctrlPts, closed, subdiv, smoothness)
    local lengths = sim.getPathLengths(ctrlPts, 7)
    local method = {type = 'quadraticBezier', strength = smoothness, forceOpen = not closed, closed = closed}
    if lengths[#lengths] == 0 then return table.move(ctrlPts, 1, 7 * math.min(subdiv, #lengths), 1, {}) end
    return sim.resamplePath(ctrlPts, lengths, subdiv, method, TYPES)
end

local CREATE_ARGS = {
    {type = 'table', item_type = 'float', size = '14..*'}, {type = 'int', default = 0}, {type = 'int', default = 100},
    {type = 'float', default = 1.0}, {type = 'int', default = 0},
    {type = 'table', item_type = 'float', size = 3, default = {0, 0, 1}},
}

--- Creates a path object from control points.
-- @api int pathHandle = sim.createPath(float[] ctrlPts, int options = 0, int subdiv = 100, float smoothness = 1.0, int orientationMode = 0, float[3] upVector = {0, 0, 1})
-- @param ctrlPts poses, seven numbers each, at least two
-- @param options 2 closed, 16 orientation computed from the direction
-- @param subdiv number of points of the sampled path
-- @param smoothness strength of the rounded corners, 0 to 1
-- @param orientationMode axes along the path and up: 0 xy, 1 xz, 2 yx, 3 yz, 4 zx, 5 zy
-- @param upVector what is up when the orientation is computed
-- @return pathHandle a dummy, with custom data PATHCTRLPTS and PATH (seven doubles per point)
function M.createPath(...)
    local ctrlPts, options, subdiv, smoothness, mode, up = check(CREATE_ARGS, ...)
    local closed = options & CLOSED ~= 0
    local path = samplePath(ctrlPts, closed, subdiv, smoothness)
    if options & COMPUTE_ORIENTATION ~= 0 and mode >= 0 then
        orientAlongPath(path, closed, up, mode)
    end
    local handle = sim.createDummy(0.04)
    sim.setObjectAlias(handle, 'Path')
    sim.setBoolProperty(handle, 'modelBase', true)
    sim.setBufferProperty(handle, 'customData.PATHCTRLPTS', sim.packDoubleTable(ctrlPts))
    sim.setBufferProperty(handle, 'customData.PATH', sim.packDoubleTable(path))
    return handle
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
