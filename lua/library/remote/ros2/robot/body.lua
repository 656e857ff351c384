--[[
The objects of a robot: which object carries a link, and where the links' frames are. Internal.

An import makes shapes whose frames are not those of the links. Frames follow from the joints, as robot_state_publisher computes them; the root's frame is found by
a joint that hangs on it.
]]

local sim = require('sim')

local M = {}

local IDENTITY <const> = {0, 0, 0, 0, 0, 0, 1}

local function multiply(a, b) return sim.multiplyPoses(a, b) end

function M.inverse(pose)
    local inverse = {table.unpack(pose)}
    sim.invertPose(inverse)
    return inverse
end

--- The rotation about an axis.
function M.rotation(axis, angle)
    local s = math.sin(angle / 2)
    return {0, 0, 0, axis[1] * s, axis[2] * s, axis[3] * s, math.cos(angle / 2)}
end

-- The objects of a tree by their aliases; of equal ones the first.
local function byAlias(base)
    local found = {}
    for _, object in ipairs(sim.getObjectsInTree(base)) do
        local alias = sim.getObjectAlias(object)
        found[alias] = found[alias] or object
    end
    return found
end

local function ofLink(objects, alias) return objects[alias .. '_respondable'] or objects[alias .. '_visual'] end

--- Whether an object is the base of what is described.
function M.isOf(base, description)
    local objects, count = byAlias(base), 0
    for _, joint in ipairs(description.joints) do
        if joint.kind ~= 'fixed' then
            if not objects[joint.alias] then return false end
            count = count + 1
        end
    end
    if count > 0 then return true end
    for _, link in ipairs(description.links) do
        if ofLink(objects, link.alias) then return true end
    end
    return false
end

-- How a joint moves what hangs on it, in its own frame.
local function motion(joint, object)
    if joint.kind == 'fixed' or not object then return IDENTITY end
    if joint.kind == 'other' then
        return sim.getObjectType(object) == sim.sceneobject_joint and sim.getObjectChildPose(object) or IDENTITY
    end
    local position = sim.getJointPosition(object)
    if joint.kind == 'revolute' then return M.rotation(joint.axis, position) end
    return {joint.axis[1] * position, joint.axis[2] * position, joint.axis[3] * position, 0, 0, 0, 1}
end

--- The frame of a joint's child in that of its parent.
function M.transform(body, joint)
    local moved = multiply(joint.origin, motion(joint, body.objects[joint.alias]))
    return multiply(moved, joint.childPose)
end

-- The smallest rotation that takes z to an axis, by which an import turns joints.
local function alongAxis(axis)
    if axis[3] < -1 + 1e-12 then return {0, 0, 0, 1, 0, 0, 0} end
    local x, y, w = -axis[2], axis[1], 1 + axis[3]
    local length = math.sqrt(x * x + y * y + w * w)
    return {0, 0, 0, x / length, y / length, 0, w / length}
end

-- The frame of the root by an object below it whose place in the root's frame is known.
local function rootFrame(body)
    for _, joint in ipairs(body.joints) do
        local object = body.objects[joint.alias]
        if object and joint.kind ~= 'other' then
            local place = multiply(body.inRoot[joint.parent], joint.origin)
            if joint.kind == 'revolute' or joint.kind == 'prismatic' then place = multiply(place, alongAxis(joint.axis)) end
            return multiply(sim.getObjectPose(object), M.inverse(place))
        end
    end
    return sim.getObjectPose(body.base)
end

-- What moves with the root: its shape, or that of a link which is fixed to it.
local function rootCarrier(body, description)
    local fixed = {[body.root] = true}
    for _, link in ipairs(description.links) do
        local joint = body.above[link.name]
        fixed[link.name] = fixed[link.name] or joint and joint.kind == 'fixed' and fixed[joint.parent]
        local object = fixed[link.name] and ofLink(body.objects, link.alias)
        if object then return object end
    end
    return body.base
end

-- What carries each link: its shape, else the joint above it, else what carries its parent.
local function carriers(body, description)
    for _, link in ipairs(description.links) do
        local joint = body.above[link.name]
        local above = joint and (body.objects[joint.alias] or body.carriers[joint.parent])
        body.carriers[link.name] = ofLink(body.objects, link.alias) or above or rootCarrier(body, description)
    end
end

-- Frames of all links in that of their root.
local function placeLinks(body, description)
    for _, link in ipairs(description.links) do
        local joint = body.above[link.name]
        body.inRoot[link.name] = joint and multiply(body.inRoot[joint.parent], M.transform(body, joint)) or IDENTITY
    end
end

--- The body of a robot. Without a description (a scene) links are objects, by their aliases.
function M.new(base, description)
    local body = {base = base, objects = byAlias(base), joints = description.joints, above = {}, carriers = {}, inRoot = {}}
    body.isDescribed = #description.links > 0
    body.root = body.isDescribed and description.links[1].name or sim.getObjectAlias(base)
    for _, joint in ipairs(description.joints) do body.above[joint.child] = joint end
    carriers(body, description)
    placeLinks(body, description)
    local offset = body.isDescribed and multiply(M.inverse(sim.getObjectPose(body.carriers[body.root])), rootFrame(body)) or IDENTITY

    --- The frame of the root in the world, now.
    function body.rootPose() return multiply(sim.getObjectPose(body.carriers[body.root] or base), offset) end

    --- What a link is, as it was at first: the object that carries it and its frame in the world. An error if there is none.
    function body.link(name)
        if not name or name == '' then return base, body.rootPose() end
        if body.inRoot[name] then return body.carriers[name], multiply(body.rootPose(), body.inRoot[name]) end
        local object = body.objects[name]
        if not object then
            object = sim.getObject(name, {noError = true})
            if object == -1 then error(("there is no link '%s'"):format(name), 0) end
        end
        return object, sim.getObjectPose(object)
    end

    --- Whether there is a link of that name.
    function body.has(name) return body.inRoot[name] ~= nil or not body.isDescribed and body.objects[name] ~= nil end

    return body
end

return M
