--[[
Shared by the scripts of straight conveyors: the way around both ends, pads on it or rollers between them, and the frame (spec: models 5).
]]

local sim = _quietRequire 'sim'
local parts = require 'swanilda.conveyors.parts'
local M = {}

local HALF <const>, NEEDED <const> = 9, 18 -- control points of an end, and of both
local INNER <const> = 0.75 -- of the radius: how far the frame goes inside
local ROLLERS <const> = 2 -- the type of conveyors with rollers

--- The radius of the ends, and how far their centres are below the model's origin.
function M.geometry(config)
    if config.type == ROLLERS then return config.radius / 2, config.radius end
    return config.radius, config.radius + config.beltElementThickness
end

--- Poses of the control points: half a circle around each end.
function M.controlPoses(length, radius, depth)
    local poses = {}
    for _, side in ipairs{1, -1} do
        for i = 0, HALF - 1 do
            local a = math.pi / 2 - i * math.pi / (HALF - 1)
            local pitch = side * math.pi / 2 - a
            local pose = sim.buildPose({side * (radius * math.cos(a) + length / 2), 0, side * radius * math.sin(a) - depth},
                {0, pitch, 0})
            poses[#poses + 1] = pose
        end
    end
    return poses
end

--- Moves the control points of a path; orientations stay if `onlyPositions` is true.
function M.place(path, poses, onlyPositions)
    local points = path.getCtrlPts()
    if #points < NEEDED then
        error(('a conveyor needs a closed path with %d control points: there are %d'):format(NEEDED, #points), 0)
    end
    for i, pose in ipairs(poses) do
        if onlyPositions then
            sim.setObjectPosition(points[i], {pose[1], pose[2], pose[3]}, path.model)
        else
            sim.setObjectPose(points[i], pose, path.model)
        end
    end
end

--- The polygon of the control points, closed.
function M.polygon(path)
    local poses = table.move(path.paths[1], 1, #path.paths[1], 1, {})
    return table.move(poses, 1, 7, #poses + 1)
end

--- The frame: the hull of the inner part of the way.
-- @param poses flat, in the model's frame
function M.frame(poses, radius, width, config)
    local corners = {}
    for i = 1, #poses, 7 do
        local pose = table.move(poses, i, i + 6, 1, {})
        for _, height in ipairs{0, -INNER * radius} do
            for _, side in ipairs{-width / 2, width / 2} do
                local corner = sim.multiplyPoses(pose, {0, side, height, 0, 0, 0, 1})
                table.move(corner, 1, 3, #corners + 1, corners)
            end
        end
    end
    local vertices, indices = _quietRequire('simConvex').qhull(corners)
    local shape = sim.createShape(0, 0, vertices, indices)
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, parts.colour(config.frameColor))
    sim.setBoolProperty(shape, 'respondable', config.respondable and true or false)
    sim.setBoolProperty(shape, 'dynamic', false)
    return shape
end

--- Pads on a closed way. The result puts them where they are when the belt has moved by `pos`.
function M.pads(model, config, poses, existing)
    local width, thickness = config.beltElementWidth, config.beltElementThickness
    local way = parts.way(poses, thickness / 2)
    local count = parts.checkedCount(way.length // (width + config.beltElementSpacing))
    local pitch, pads = way.length / count, existing
    if #pads ~= count then
        parts.clear(model)
        pads = {}
        for i = 1, count do
            pads[i] = parts.addPad(model, {width, config.width, thickness}, parts.colour(config.color), config.respondable)
        end
    end
    return function(pos)
        for k, pad in ipairs(pads) do
            if sim.isHandle(pad) then sim.setObjectPose(pad, way.at((pos + (k - 1) * pitch) % way.length), model) end
        end
    end
end

--- Rollers between the ends. The result turns them.
function M.rollers(model, config, depth, existing)
    local count, joints = parts.checkedCount(config.rollerCnt), existing
    if #joints ~= count then
        parts.clear(model)
        joints = {}
        for k = 1, count do
            local x = count > 1 and (k - 1) * config.length / (count - 1) or config.length / 2
            local pose = sim.buildPose({x - config.length / 2, 0, -depth}, {-math.pi / 2, 0, 0})
            joints[k] = parts.addRoller(model, pose, config.radius, config.width, parts.colour(config.color), config.respondable)
        end
    end
    return function(pos)
        for _, joint in ipairs(joints) do
            if sim.isHandle(joint) then sim.setJointPosition(joint, pos / config.radius) end
        end
    end
end

--- Pads or rollers; those that are there are used again unless the settings are new.
function M.build(path, config, poses, depth, isNew)
    local model = path.model
    if isNew then parts.clear(model) end
    if config.type == ROLLERS then return M.rollers(model, config, depth, isNew and {} or parts.rollers(model)) end
    return M.pads(model, config, poses, isNew and {} or parts.pads(model))
end

return M
