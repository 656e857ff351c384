--[[
Shared by the scripts of conveyor systems, which run along any path: pads or rollers, the base under them, and borders (spec: models 5).

A plan has `isClosed`, `width`, `useRollers`, `pad` {length, thickness, spacing}, `roller` {radius, spacing}, `color`, `frameColor`, `respondable`,
`respondableBase` and `border` {length, height, thickness}, nil without borders.
]]

local sim = _quietRequire 'sim'
local parts = require 'swanilda.conveyors.parts'
local M = {}

local PAD_LAYER <const>, BASE_LAYER <const>, BORDER_LAYER <const> = 257, 256, 257
local PAD_WIDTH <const> = 0.95 -- of the width of the conveyor
local BASE_LENGTH <const>, BASE_HEIGHT <const>, BASE_STEP <const> = 0.05, 0.02, 0.025 -- m

local checked = parts.checkedCount

--- How many pads there are, how far apart, and the length after which they are back at the start.
function M.padLayout(length, pad, isClosed)
    local pitch = pad.length + pad.spacing
    if isClosed then
        local count = checked(length // pitch)
        return count, length / count, length
    end
    local count = checked(1 + length // pitch)
    return count, pitch, pitch * count
end

--- How many rollers there are, and how far apart.
function M.rollerLayout(length, roller, isClosed)
    local pitch = 2 * roller.radius + roller.spacing
    if isClosed then
        local count = checked(length // pitch)
        return count, length / count
    end
    local count = checked(1 + length // pitch)
    return count, count > 1 and length / (count - 1) or 0
end

local function lowered(pose, depth)
    pose[3] = pose[3] - depth
    return pose
end

local function buildPads(model, way, plan)
    local count, pitch, wrap = M.padLayout(way.length, plan.pad, plan.isClosed)
    local pads, places = {}, {}
    for i = 1, count do
        pads[i] = parts.addPad(model, {plan.pad.length, PAD_WIDTH * plan.width, plan.pad.thickness}, plan.color, plan.respondable, PAD_LAYER)
    end
    return function(pos)
        for k, pad in ipairs(pads) do
            if sim.isHandle(pad) then
                local s = (pos + (k - 1) * pitch) % wrap
                -- From the end to the start: what lies there is not hit on the way.
                local jumps = places[k] and math.abs(s - places[k]) > wrap / 2
                places[k] = s
                local pose = way.at(s > way.length and s - pitch or s)
                sim.setObjectPose(pad, lowered(pose, plan.pad.thickness / 2), model)
                if jumps then sim.resetDynamicObject(pad) end
            end
        end
    end
end

local ACROSS <const> = {0, 0, 0, -math.sqrt(0.5), 0, 0, math.sqrt(0.5)} -- z becomes the y axis of the path

local function buildRollers(model, way, plan)
    local radius = plan.roller.radius
    local count, pitch = M.rollerLayout(way.length, plan.roller, plan.isClosed)
    local joints = {}
    for i = 1, count do
        local pose = sim.multiplyPoses(lowered(way.at((i - 1) * pitch), radius), ACROSS)
        joints[i] = parts.addRoller(model, pose, radius, plan.width, plan.color, plan.respondable)
    end
    return function(pos)
        for _, joint in ipairs(joints) do
            if sim.isHandle(joint) then sim.setJointPosition(joint, pos / radius) end
        end
    end
end

-- How far the carrying parts reach below the path.
local function depthOf(plan) return plan.useRollers and 2 * plan.roller.radius or plan.pad.thickness end

local function addBase(model, way, plan)
    local boxes, depth = {}, depthOf(plan) + BASE_HEIGHT / 2
    for i = 0, checked(way.length // BASE_STEP) do
        boxes[#boxes + 1] = {
            pose = lowered(way.at(math.min(i * BASE_STEP, way.length)), depth), sizes = {BASE_LENGTH, plan.width, BASE_HEIGHT},
        }
    end
    parts.addBoxes(model, boxes, 'respondable', 'b', plan.frameColor, BASE_LAYER)
end

local function addBorders(model, way, plan)
    local border, boxes = plan.border, {}
    local half = border.length / 2
    local count = checked(way.length // half)
    for i = 1, count do
        local pose = way.at((i - 0.5) * way.length / count)
        for _, side in ipairs{-1, 1} do
            local y = side * (plan.width + border.thickness) / 2
            boxes[#boxes + 1] = {
                pose = sim.multiplyPoses(pose, {0, y, border.height / 2, 0, 0, 0, 1}), sizes = {half, border.thickness, border.height},
            }
        end
    end
    parts.addBoxes(model, boxes, 'border', 'c', plan.frameColor, BORDER_LAYER)
end

--- The frame below the parts, a shape along the path.
-- @param poses of the path, flat
function M.frame(poses, plan)
    local depth, w = depthOf(plan), plan.width / 2
    local section = {w, -depth, -w, -depth, -w, -depth - BASE_HEIGHT, w, -depth - BASE_HEIGHT, w, -depth}
    local shape = sim.generateShapeFromPath(poses, section, plan.isClosed and 4 or 0, {0, 0, 1})
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, plan.frameColor)
    return shape
end

--- Makes all parts anew. The result puts them where they are when the belt has moved by `pos`.
function M.build(path, plan)
    local model, way = path.model, parts.way(path.paths[2], 0)
    parts.clear(model)
    path.setPathShape(M.frame(path.paths[2], plan))
    if plan.respondableBase then addBase(model, way, plan) end
    if plan.border then addBorders(model, way, plan) end
    return plan.useRollers and buildRollers(model, way, plan) or buildPads(model, way, plan)
end

return M
