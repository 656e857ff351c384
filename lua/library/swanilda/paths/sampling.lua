--[[
Shared by pathmodel.lua: points at equal distances along a path, from its control points (spec: paths 2).

A row is what a path has at a point: position, quaternion, virtual distance and four auxiliary channels. The virtual distance counts like a
fourth coordinate in distances. Knows no objects of the scene.
]]

local sim = _quietRequire 'sim'
local quaternion = require 'swanilda.quaternion'
local M = {}

local COLUMNS <const>, POSE <const>, EXTRA <const>, VIRTUAL <const> = 12, 7, 5, 8
local TYPES <const> = {0, 0, 0, 2, 2, 2, 2, 0, 0, 0, 0, 0}
local CLOSED <const>, COMPUTE_ORIENTATION <const> = 2, 16
local COINCIDENT <const> = 1e-4 -- m

---------------------------------------------------------------- orientations

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

-- The direction at a point is that from the point before it to the one after it. A closed path ends where it begins. Where there is no
-- direction, the orientation is that of the point before.
local function orientAlongPath(rows, closed, up, mode)
    local count, last = #rows // COLUMNS, nil
    local function start(i)
        i = closed and (i - 1) % (count - 1) + 1 or math.max(1, math.min(count, i))
        return COLUMNS * (i - 1)
    end
    for i = 1, count do
        local a, b, direction, square = start(i - 1), start(i + 1), {}, 0
        for k = 1, 3 do
            direction[k] = rows[b + k] - rows[a + k]
            square = square + direction[k] ^ 2
        end
        last = square >= COINCIDENT ^ 2 and orientationAlong(direction, up, mode) or last
        if last then table.move(last, 1, 4, COLUMNS * (i - 1) + 4, rows) end
    end
end

---------------------------------------------------------------- samples

-- Only position and virtual distance make a way longer.
local function distance(a, b)
    local sum = (b[VIRTUAL] - a[VIRTUAL]) ^ 2
    for k = 1, 3 do sum = sum + (b[k] - a[k]) ^ 2 end
    return math.sqrt(sum)
end

local function evenly(rows, count, method)
    return sim.resamplePath(rows, (sim.getPathLengths(rows, COLUMNS, distance)), count, method, TYPES)
end

local function isOnePoint(rows)
    local _, total = sim.getPathLengths(rows, COLUMNS, distance)
    return total == 0
end

--- pointCnt rows at equal distances along the control points; a closed path ends with its first point.
-- @param rows of the control points, flat; that of a closed path without the first one again
-- @param info as returned by pathmodel.info
function M.sample(rows, info)
    local closed = info.bitCoded & CLOSED ~= 0
    rows = table.move(rows, 1, #rows, 1, {})
    if closed then table.move(rows, 1, COLUMNS, #rows + 1) end
    if isOnePoint(rows) then return table.move(rows, 1, COLUMNS * math.min(info.pointCnt, #rows // COLUMNS), 1, {}) end
    if info.smoothing ~= 0 then
        -- Corners are shorter when they are rounded: equal distances take a second pass, over twice as many points.
        local method = {type = 'quadraticBezier', strength = info.smoothing, forceOpen = not closed}
        rows = evenly(rows, 2 * info.pointCnt, method)
    end
    rows = evenly(rows, info.pointCnt)
    if info.bitCoded & COMPUTE_ORIENTATION ~= 0 and info.autoOrientation >= 0 then
        orientAlongPath(rows, closed, info.upVector, info.autoOrientation)
    end
    return rows
end

--- The poses of rows, and the virtual distances and auxiliary channels, both flat.
function M.split(rows)
    local poses, extra = {}, {}
    for i = 0, #rows // COLUMNS - 1 do
        table.move(rows, COLUMNS * i + 1, COLUMNS * i + POSE, POSE * i + 1, poses)
        table.move(rows, COLUMNS * i + POSE + 1, COLUMNS * (i + 1), EXTRA * i + 1, extra)
    end
    return poses, extra
end

--- Rows of poses, seven numbers each, without virtual distances.
function M.ofPoses(poses)
    local rows = {}
    for i = 0, #poses // POSE - 1 do
        table.move(poses, POSE * i + 1, POSE * (i + 1), COLUMNS * i + 1, rows)
        for k = 1, EXTRA do rows[COLUMNS * i + POSE + k] = 0.0 end
    end
    return rows
end

return M
