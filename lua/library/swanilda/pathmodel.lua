--[[
Shared by sim/pathobject.lua and path_customization.lua: path objects in the scene. A path object is a dummy that carries control points
and a sampled path as custom data; dummies below it mark the control points and can be moved, copied and removed.

Does not draw a path; M.update applies movements of the dummies when it is called.
]]

local sim = package.loaded.sim or require 'sim'
local M = {}
local quaternion = require 'swanilda.quaternion'

local HIDDEN <const>, CLOSED <const>, EXTRUDED <const>, COMPUTE_ORIENTATION <const> = 1, 2, 4, 16 -- the other options are about drawing
local TYPES <const> = {0, 0, 0, 2, 2, 2, 2}
local SECTION <const> = {0.01, -0.01, 0.01, 0.01, -0.01, 0.01, -0.01, -0.01, 0.01, -0.01}
local INFO <const>, POINT <const>, SHAPE <const> = 'customData.ABC_PATH_INFO', 'customData.ABC_PATHCTRLPT', 'customData.ABC_PATHSHAPE'
local CONTROL_POINTS <const>, PATH <const> = 'customData.PATHCTRLPTS', 'customData.PATH'
local MOVED <const> = 1e-6 -- m, and parts of a quaternion

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

-- The direction at a point is that from the point before it to the one after it. A closed path ends where it begins.
local function orientAlongPath(path, closed, up, mode)
    local count = #path // 7
    local function position(i)
        i = closed and (i - 1) % (count - 1) + 1 or math.max(1, math.min(count, i))
        return path[7 * i - 6], path[7 * i - 5], path[7 * i - 4]
    end
    for i = 1, count do
        local ax, ay, az = position(i - 1)
        local bx, by, bz = position(i + 1)
        local q = orientationAlong({bx - ax, by - ay, bz - az}, up, mode)
        if q then table.move(q, 1, 4, 7 * i - 3, path) end
    end
end

---------------------------------------------------------------- sampling

--- The path through control points: pointCnt poses at equal distances.
function M.sample(points, info)
    local lengths, total = sim.getPathLengths(points, 7)
    if total == 0 then return table.move(points, 1, 7 * math.min(info.pointCnt, #lengths), 1, {}) end
    local closed = info.bitCoded & CLOSED ~= 0
    local method = {type = 'quadraticBezier', strength = info.smoothing, forceOpen = not closed, closed = closed}
    -- Corners are shorter when they are rounded: equal distances take a second pass, over twice as many points.
    local fine = sim.resamplePath(points, lengths, 2 * info.pointCnt, method, TYPES)
    local path = sim.resamplePath(fine, sim.getPathLengths(fine, 7), info.pointCnt, nil, TYPES)
    if info.bitCoded & COMPUTE_ORIENTATION ~= 0 and info.autoOrientation >= 0 then
        orientAlongPath(path, closed, info.upVector, info.autoOrientation)
    end
    return path
end

---------------------------------------------------------------- the objects

local function read(object, name) return sim.getBufferProperty(object, name, {noError = true}) end

local function write(object, name, numbers) sim.setBufferProperty(object, name, sim.packDoubleTable(numbers)) end

local function children(object)
    local list, child = {}, sim.getObjectChild(object, 0)
    while child >= 0 do
        list[#list + 1] = child
        child = sim.getObjectChild(object, #list)
    end
    return list
end

--- What a path is made with: bitCoded, pointCnt, smoothing, autoOrientation, upVector. Nil of an object that is no path.
function M.info(path)
    local packed = read(path, INFO)
    local info = packed and #packed > 0 and sim.unpackTable(packed)
    if type(info) ~= 'table' then return nil end
    info.bitCoded = math.tointeger(info.bitCoded) or 0
    info.pointCnt = math.max(2, math.tointeger(info.pointCnt) or 100)
    info.autoOrientation = math.tointeger(info.autoOrientation) or 0
    info.smoothing, info.upVector = tonumber(info.smoothing) or 1.0, info.upVector or {0, 0, 1}
    return info
end

--- The dummies of the control points in order. A copy of one comes after it.
function M.controlPoints(path)
    local found = {}
    for place, child in ipairs(children(path)) do
        local packed = read(child, POINT)
        local index = packed and #packed > 0 and sim.unpackTable(packed).index
        if index then found[#found + 1] = {handle = child, index = index, place = place} end
    end
    table.sort(found, function(a, b)
        if a.index ~= b.index then return a.index < b.index end
        return a.place < b.place
    end)
    local handles = {}
    for i, point in ipairs(found) do handles[i] = point.handle end
    return handles
end

local function mark(point, index) sim.setBufferProperty(point, POINT, sim.packTable{handle = point, index = index}) end

local function addPoint(path, pose, index)
    local point = sim.createDummy(0.01)
    sim.setObjectAlias(point, 'ctrlPt')
    sim.setObjectParent(point, path, true)
    sim.setObjectPose(point, pose, path)
    mark(point, index)
end

--- A path object with its control points; info as returned by M.info.
function M.create(points, info)
    local path = sim.createDummy(0.04)
    sim.setObjectAlias(path, 'Path')
    sim.setBoolProperty(path, 'modelBase', true)
    sim.setBufferProperty(path, INFO, sim.packTable(info))
    for i = 1, #points // 7 do addPoint(path, table.move(points, 7 * i - 6, 7 * i, 1, {}), i) end
    write(path, CONTROL_POINTS, points)
    write(path, PATH, M.sample(points, info))
    local script = sim.createScript(sim.scripttype_customization, "path = require('path_customization')")
    sim.setObjectParent(script, path, true)
    return path
end

---------------------------------------------------------------- what follows the control points

local function differ(a, b)
    if #a ~= #b then return true end
    for i = 1, #a do
        if math.abs(a[i] - b[i]) > MOVED then return true end
    end
    return false
end

local function posesOf(handles, path)
    local poses = {}
    for i, handle in ipairs(handles) do table.move(sim.getObjectPose(handle, path), 1, 7, 7 * i - 6, poses) end
    return poses
end

local function extrude(path, closed, up)
    local shape = sim.generateShapeFromPath(path, SECTION, closed and 4 or 0, up)
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, {0.85, 0.85, 0.85})
    return shape
end

-- shaping(path, closed, upVector) makes the shape along a path, extrude where a script does not say how.
local function replaceShape(object, path, info, shaping)
    for _, child in ipairs(children(object)) do
        if read(child, SHAPE) then sim.removeObjects{child} end
    end
    if info.bitCoded & EXTRUDED == 0 then return end
    local made, shape = pcall(shaping or extrude, path, info.bitCoded & CLOSED ~= 0, info.upVector)
    if not made then error('the shape along the path: ' .. tostring(shape), 0) end
    sim.setObjectParent(shape, object, false)
    sim.setBufferProperty(shape, SHAPE, sim.packTable{1})
end

--- Resamples a path if its control points have moved. Returns whether they have.
function M.update(object, shaping)
    local info, handles = M.info(object), M.controlPoints(object)
    if not info or #handles < 2 then return false end
    local points, before = posesOf(handles, object), read(object, CONTROL_POINTS)
    if before and not differ(points, sim.unpackDoubleTable(before)) then return false end
    for i, handle in ipairs(handles) do mark(handle, i) end
    local path = M.sample(points, info)
    write(object, CONTROL_POINTS, points)
    write(object, PATH, path)
    replaceShape(object, path, info, shaping)
    return true
end

--- The shape along a path that was just made.
function M.addShape(object)
    replaceShape(object, sim.unpackDoubleTable(read(object, PATH)), M.info(object))
end

--- Hides a path during a simulation, or shows it again, if its options say so.
function M.setHidden(path, hidden)
    local info = M.info(path)
    if not info or info.bitCoded & HIDDEN == 0 then return end
    local property = sim.getModelProperty(path)
    local flag = sim.modelproperty_not_visible
    sim.setModelProperty(path, hidden and property | flag or property & ~flag)
end

return M
