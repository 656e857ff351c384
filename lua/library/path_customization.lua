--[[
Customization script of path objects: `path = require('path_customization')`. The path is made anew when its control points, dummies below it, move while
the simulation is stopped, are copied or removed, and when the script begins (spec: models 2).

A script may define `path.shaping(points, closed, upVector)`, which makes the shape along the path, and `path.refreshTrigger(controlPoints, points, info)`,
which is called when the path was made anew. One with its own `sysCall_init` calls `path.init()`.
]]

local model = require 'swanilda.pathmodel'
local points = require 'swanilda.paths.points'
local line = require 'swanilda.paths.line'
sim = _quietRequire 'sim' -- scripts find it as a global, as in the original
local path = {ctrlPts = {}, ctrlPtsMap = {}, paths = {}}
_S.path = path

local HIDDEN <const>, ALWAYS_HIDDEN <const> = 1, 32 -- the first during a simulation
local poses -- of the control points when the path was last looked at

-- The script is an object below the path; in scenes from before there were such, it belongs to the path itself.
local function owner()
    local object = sim.getObject('.')
    local isScript = sim.getObjectType(object) == sim.sceneobject_script
    return isScript and sim.getObjectParent(object) or object
end

local function isRunning() return sim.getSimulationState() ~= sim.simulation_stopped end

local function showPoints()
    local isVisible = not isRunning() and path.readInfo().bitCoded & ALWAYS_HIDDEN == 0
    points.show(path.ctrlPts, isVisible)
end

local function take(list)
    path.ctrlPts, path.ctrlPtsMap = list, {}
    for _, point in ipairs(list) do path.ctrlPtsMap[point.handle] = true end
end

--- Handles of the control points, in order.
function path.getCtrlPts()
    local handles = {}
    for i, point in ipairs(points.list(path.model)) do handles[i] = point.handle end
    return handles
end

--- Settings: bitCoded, pointCnt, smoothing, autoOrientation, upVector, line, ctrlPtFixedSize.
function path.readInfo() return model.info(path.model) end

--- Stores settings. They count at the next setup.
function path.writeInfo(info) model.writeInfo(path.model, info) end

--- Makes a shape that of the path, instead of the one it had; -1: none.
function path.setPathShape(shape) model.setShape(path.model, shape or -1) end

--- Replaces control points and settings.
-- @param pts poses, or positions if onlyPositions is true; flat
function path.createNew(pts, onlyPositions, options, pointCount, smoothing, mode, up)
    local all = pts
    if onlyPositions then
        all = {}
        for i = 1, #pts // 3 do
            table.move({pts[3 * i - 2], pts[3 * i - 1], pts[3 * i], 0, 0, 0, 1}, 1, 7, 7 * i - 6, all)
        end
    end
    local info = path.readInfo()
    info.bitCoded, info.pointCnt = options or info.bitCoded, pointCount or info.pointCnt
    info.smoothing, info.autoOrientation = smoothing or info.smoothing, mode or info.autoOrientation
    info.upVector = up or info.upVector
    model.renew(path.model, all, info)
end

local function drawLine()
    local options = path.readInfo().bitCoded
    local isHidden = options & ALWAYS_HIDDEN ~= 0 or isRunning() and options & HIDDEN ~= 0
    line.remove(path.line)
    path.line = not isHidden and path.paths[2] and line.draw(path.model, path.paths[2], path.readInfo().line) or nil
end

local function refresh(handles)
    local info = path.readInfo()
    model.shape(path.model, path.paths[2], path.shaping)
    drawLine()
    if path.refreshTrigger then path.refreshTrigger(handles, path.paths[2], info) end
    showPoints()
end

--- Brings the path up to date. One that has one control point left is removed.
-- @return handles of the control points, and the path: seven numbers per point
function path.setup()
    local list = points.list(path.model)
    if #list < 2 then
        if model.isPath(path.model) then sim.removeModel(path.model, true) end
        return {}, {}
    end
    points.number(list)
    take(list)
    local isForced = path.forceFullRebuild
    path.forceFullRebuild, poses = false, points.poses(list, path.model)
    local isNew
    path.paths, isNew = model.update(path.model, list, isForced)
    local handles = path.getCtrlPts()
    if isNew then refresh(handles) end
    return handles, path.paths[2]
end

--- Begins: everything is made anew.
function path.init()
    path.model = owner()
    model.renewFromBlock(path.model)
    path.forceFullRebuild = true
    path.setup()
end

local function haveMoved()
    local list = points.list(path.model)
    local now = points.poses(list, path.model)
    if not poses or #now ~= #poses then return true end
    for i = 1, #now do
        if now[i] ~= poses[i] then return true end
    end
    return false
end

--- Looks for control points that were moved, added or removed.
function path.nonSimulation()
    if path.model and sim.isHandle(path.model) and haveMoved() then path.setup() end
end

function path.beforeSimulation()
    path.nonSimulation()
    if not path.model then return end
    model.setHidden(path.model, true)
    points.show(path.ctrlPts, false)
    if path.readInfo().bitCoded & HIDDEN ~= 0 then
        line.remove(path.line)
        path.line = nil
    end
end

function path.afterSimulation()
    if not path.model then return end
    model.setHidden(path.model, false)
    showPoints()
    if not path.line then drawLine() end
end

function path.cleanup() path.closeUserConfigDlg() end

--- Opens the dialog of the path; a page of `swanilda view` shows it.
function path.openUserConfigDlg() require('swanilda.paths.dialog').open(path) end

function path.closeUserConfigDlg()
    if path.dialog then require('swanilda.paths.dialog').close(path) end
end

---------------------------------------------------------------- copies of control points

-- Copies know from which path they are: one without a parent joins it, behind the point with the highest number that was copied.
local last -- number

local function ownAmong(handles)
    local found = {}
    for handle in pairs(handles) do
        if path.ctrlPtsMap[handle] and sim.isHandle(handle) then found[#found + 1] = handle end
    end
    return found
end

local function mark(handles, id)
    if id then last = 0 end
    for _, handle in ipairs(ownAmong(handles)) do
        local data = points.read(handle)
        if id then last = math.max(last, data.index) end
        data.pathId = id
        points.write(handle, data)
    end
end

local function adopt(created)
    local mine = sim.getObjectUid(path.model)
    local adopted = {}
    for _, handle in ipairs(created) do
        local data = sim.getObjectParent(handle) == -1 and points.read(handle)
        if data and data.pathId == mine then adopted[#adopted + 1] = handle end
    end
    for i, handle in ipairs(adopted) do
        local data = points.read(handle)
        data.index, data.pathId = (last or data.index) + i / (#adopted + 1), nil
        sim.setObjectParent(handle, path.model, true)
        points.write(handle, data)
    end
    if #adopted > 0 then path.setup() end
end

function sysCall_beforeCopy(data) mark(data.objectHandles, path.model and sim.getObjectUid(path.model)) end

function sysCall_afterCopy(data) mark(data.objectHandles, nil) end

function sysCall_afterCreate(data)
    if path.model and sim.isHandle(path.model) then adopt(data.objects) end
end

function sysCall_afterDelete(data)
    local isHere = path.model and sim.isHandle(path.model)
    for handle in pairs(isHere and data.objectHandles or {}) do
        if path.ctrlPtsMap[handle] then return path.setup() end
    end
end

---------------------------------------------------------------- callbacks

function sysCall_init() path.init() end

function sysCall_cleanup() path.cleanup() end

function sysCall_nonSimulation() path.nonSimulation() end

function sysCall_beforeSimulation() path.beforeSimulation() end

function sysCall_afterSimulation() path.afterSimulation() end

function sysCall_userConfig() path.openUserConfigDlg() end

return path
