--[[
Shared by sim/pathobject.lua and path_customization.lua: path objects in the scene (spec: paths 2). A path object is a dummy that carries control
points and a sampled path as custom data; dummies below it mark the control points and can be moved, copied and removed.

When a path is made anew is decided by path_customization.lua.
]]

local sim = _quietRequire 'sim'
local points = require 'swanilda.paths.points'
local sampling = require 'swanilda.paths.sampling'
local M = {}

local HIDDEN <const>, CLOSED <const>, EXTRUDED <const> = 1, 2, 4 -- other options are about drawing
local SECTION <const> = {0.01, -0.01, 0.01, 0.01, -0.01, 0.01, -0.01, -0.01, 0.01, -0.01}
local INFO <const>, CREATION <const> = 'customData.ABC_PATH_INFO', 'customData.ABC_PATH_CREATION'
-- The second is what earlier versions of Swanilda wrote.
local SHAPE <const>, EARLIER_SHAPE <const> = 'customData.ABC_PATHSHAPE_INFO', 'customData.ABC_PATHSHAPE'
local COLOUR <const> = {0.85, 0.85, 0.85}
local FINGERPRINT <const> = '__pathFingerPrint__'
local TOLERANCE <const> = 1e-4 -- m, and parts of a quaternion
local BLOCKS <const> = {'PATHCTRLPTS', 'PATH', 'PATHCTRLPTS_X', 'PATH_X'}

---------------------------------------------------------------- settings

local function read(object, name) return sim.getBufferProperty(object, name, {noError = true}) end

local function unpacked(object, name)
    local packed = read(object, name)
    local data = packed and #packed > 0 and sim.unpackTable(packed)
    return type(data) == 'table' and data or nil
end

local function vector(value)
    local isVector = type(value) == 'table' and tonumber(value[1]) and tonumber(value[2]) and tonumber(value[3])
    return isVector and value or {0, 0, 1}
end

local function complete(info)
    info.bitCoded = math.tointeger(info.bitCoded) or 1
    info.pointCnt = math.max(2, math.tointeger(info.pointCnt) or 200)
    info.autoOrientation = math.tointeger(info.autoOrientation) or 0
    info.smoothing, info.upVector = tonumber(info.smoothing) or 1.0, vector(info.upVector)
    info.ctrlPtFixedSize = info.ctrlPtFixedSize or false
    info.line = info.line or {color = {0, 0.96, 0.66}, thickness = 3}
    return info
end

--- Whether an object is a path.
function M.isPath(object) return read(object, INFO) ~= nil or read(object, CREATION) ~= nil end

--- What a path is made with: bitCoded, pointCnt, smoothing, autoOrientation, upVector, line, ctrlPtFixedSize.
function M.info(path) return complete(unpacked(path, INFO) or {}) end

--- Stores what a path is made with.
function M.writeInfo(path, info) sim.setBufferProperty(path, INFO, sim.packTable(info)) end

---------------------------------------------------------------- new paths

local function writeBlocks(path, rows, sampled)
    local controlPoses, controlExtra = sampling.split(rows)
    local poses, extra = sampling.split(sampled)
    local lists = {controlPoses, poses, controlExtra, extra}
    for i, name in ipairs(BLOCKS) do
        sim.setBufferProperty(path, 'customData.' .. name, sim.packDoubleTable(lists[i]))
    end
    return lists
end

local function addPoints(path, poses)
    for i = 1, #poses // 7 do points.add(path, table.move(poses, 7 * i - 6, 7 * i, 1, {}), i) end
end

--- A path object with its control points; info as returned by M.info.
function M.create(poses, info)
    local path = sim.createDummy(0.04)
    sim.setObjectAlias(path, 'Path')
    sim.setBoolProperty(path, 'modelBase', true)
    M.writeInfo(path, info)
    addPoints(path, poses)
    local rows = sampling.ofPoses(poses)
    writeBlocks(path, rows, sampling.sample(rows, complete(info)))
    local script = sim.createScript(sim.scripttype_customization, "path = require('path_customization')")
    sim.setObjectParent(script, path, true)
    sim.setObjectHierarchyOrder(script, 0)
    return path
end

--- Replaces the control points and settings of a path.
function M.renew(path, poses, info)
    local old = {}
    for _, child in ipairs(points.children(path)) do
        if sim.getObjectType(child) == sim.sceneobject_dummy then old[#old + 1] = child end
    end
    if #old > 0 then sim.removeObjects(old) end
    M.writeInfo(path, info)
    addPoints(path, poses)
end

--- Does what the block of `sim.createPath` of the original asks for: control points and settings are new.
function M.renewFromBlock(path)
    local wanted = unpacked(path, CREATION)
    if not wanted then return end
    sim.setBufferProperty(path, CREATION, '')
    local info = M.info(path)
    info.bitCoded, info.pointCnt = wanted.options or 0, wanted.subdivisions or info.pointCnt
    info.smoothing, info.autoOrientation = wanted.smoothness or info.smoothing, wanted.orientationMode or 0
    info.upVector = wanted.up or info.upVector
    M.renew(path, wanted.ctrlPts or {}, complete(info))
end

---------------------------------------------------------------- the path along control points

local function fingerprint(poses, info) return {sim.packFloatTable(poses), sim.packTable(info)} end

local function isSame(path, poses, info)
    local before = sim.readCustomTableData(path, FINGERPRINT)
    if type(before) ~= 'table' or not before[1] or tostring(before[2]) ~= tostring(sim.packTable(info)) then return false end
    local old = sim.unpackFloatTable(before[1])
    if #old ~= #poses then return false end
    for i = 1, #poses do
        if math.abs(poses[i] - old[i]) > TOLERANCE then return false end
    end
    return true
end

local function stored(path)
    local lists = {}
    for i, name in ipairs(BLOCKS) do
        local packed = read(path, 'customData.' .. name)
        if not packed then return nil end
        lists[i] = sim.unpackDoubleTable(packed)
    end
    return lists
end

--- The lists of a path: poses of the control points, poses of the path, and what both have beside poses. They are sampled if control points or
--- settings have changed, or if it is forced; the second result says so.
function M.update(path, list, isForced)
    local info, rows = M.info(path), points.rows(list, path)
    local poses = sampling.split(rows)
    local known = not isForced and isSame(path, poses, info) and stored(path)
    if known then return known, false end
    local lists = writeBlocks(path, rows, sampling.sample(rows, info))
    sim.writeCustomTableData(path, FINGERPRINT, fingerprint(poses, info))
    if not info.ctrlPtFixedSize then points.resize(list, poses) end
    return lists, true
end

---------------------------------------------------------------- the shape along a path

local function extrude(path, closed, up)
    local shape = sim.generateShapeFromPath(path, SECTION, closed and 4 or 0, up)
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, COLOUR)
    return shape
end

local function shapesOf(path)
    local found = {}
    for _, child in ipairs(points.children(path)) do
        if read(child, SHAPE) or read(child, EARLIER_SHAPE) then found[#found + 1] = child end
    end
    return found
end

local function colourOf(shape)
    if not shape or sim.getObjectType(shape) ~= sim.sceneobject_shape then return nil end
    local _, colour = sim.getShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse)
    return colour
end

--- Makes a shape that of a path, instead of the one it had. -1: it has none.
function M.setShape(path, shape)
    local old = shapesOf(path)
    if #old > 0 then sim.removeObjects(old) end
    if shape == -1 then return end
    sim.setObjectParent(shape, path, false)
    sim.setObjectAlias(shape, 'shape')
    sim.setBufferProperty(shape, SHAPE, 'a')
end

--- Makes the shape along a path anew, if its settings ask for one.
-- @param shaping function(path, closed, upVector) returning a shape; default: a square section
function M.shape(path, poses, shaping)
    local info, colour = M.info(path), colourOf(shapesOf(path)[1])
    if info.bitCoded & EXTRUDED == 0 then return M.setShape(path, -1) end
    M.setShape(path, -1)
    local made, shape = pcall(shaping or extrude, poses, info.bitCoded & CLOSED ~= 0, info.upVector)
    if not made then error('the shape along the path: ' .. tostring(shape), 0) end
    if not math.tointeger(shape) then return end
    if colour then sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, colour) end
    M.setShape(path, shape)
end

--- The shape along a path that was just made.
function M.addShape(path) M.shape(path, sim.unpackDoubleTable(read(path, 'customData.PATH'))) end

--- Hides a path during a simulation, or shows it again, if its options say so.
function M.setHidden(path, hidden)
    if M.info(path).bitCoded & HIDDEN == 0 then return end
    local property = sim.getModelProperty(path)
    local flag = sim.modelproperty_not_visible
    sim.setModelProperty(path, hidden and property | flag or property & ~flag)
end

return M
