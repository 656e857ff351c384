--[[
Walking the tree of objects: visits, tags, references, relative names; bounding boxes.

Does not keep the tree: parents, children and references are native.
]]

local sim = ...
local M = {}

local function visit(handle, visitor)
    if visitor(handle) == false then return end
    local index = 0
    while true do
        local child = sim.getObjectChild(handle, index)
        if child == -1 then return end
        visit(child, visitor)
        index = index + 1
    end
end

local VISIT_ARGS = {{type = 'int'}, {type = 'func'}, {type = 'table', default = {}}}

--- Calls a function with every object of a tree, parents before children.
-- @api sim.visitTree(int rootHandle, func visitor, map options = {})
-- @param rootHandle first object visited, or sim.handle_scene
-- @param visitor function(handle); false: leave out what is below
function M.visitTree(...)
    local root, visitor = require('checkargs.check')(VISIT_ARGS, ...)
    if type(visitor) == 'string' then visitor = _G[visitor] end
    if root ~= sim.handle_scene then return visit(root, visitor) end
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene, sim.handle_all, 2)) do visit(object, visitor) end
end

--- Objects that carry custom data with a tag.
-- @api int[] objects = sim.getObjectsWithTag(string tag, bool justModels = false)
-- @param tag name of the custom data, untyped (written as a string or buffer)
-- @param justModels models only
-- @return objects breadth first
function M.getObjectsWithTag(tag, justModels)
    local objects = {}
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        if not justModels or sim.getBoolProperty(object, 'modelBase') then
            local data = sim.readCustomStringData(object, tag)
            if data and #data > 0 then objects[#objects + 1] = object end
        end
    end
    return objects
end

--- The one object referenced under a tag.
-- @api int referencedHandle = sim.getReferencedHandle(int objectHandle, string tag = '')
-- @param objectHandle the object that refers
-- @param tag of the reference
-- @return referencedHandle error if there is none, or more than one
function M.getReferencedHandle(objectHandle, tag)
    local handles = sim.getReferencedHandles(objectHandle, tag or '')
    if #handles == 0 then error('sim.getReferencedHandle: no handle found', 2) end
    if #handles > 1 then error('sim.getReferencedHandle: more than one handle found', 2) end
    return handles[1]
end

--- Adds a reference to those an object has.
-- @api sim.addReferencedHandle(int objectHandle, int referencedHandle, string tag = '', map options = {})
-- @param objectHandle the object that refers
-- @param referencedHandle the object referred to
-- @param tag of the reference
-- @param options wholeTree: refer to all objects below, too
function M.addReferencedHandle(objectHandle, referencedHandle, tag, options)
    if type(tag) == 'table' then tag, options = '', tag end
    local handles = sim.getReferencedHandles(objectHandle, tag or '')
    local added = options and options.wholeTree and sim.getObjectsInTree(referencedHandle) or {referencedHandle}
    table.move(added, 1, #added, #handles + 1, handles)
    sim.setReferencedHandles(objectHandle, handles, tag or '')
end

--- Removes the objects another one refers to, and the references.
-- @api sim.removeReferencedObjects(int objectHandle, string tag = '', bool delayed = false)
-- @param objectHandle the object that refers
-- @param tag of the references
-- @param delayed as in sim.removeObjects
function M.removeReferencedObjects(objectHandle, tag, delayed)
    local valid, seen = {}, {}
    for _, handle in ipairs(sim.getReferencedHandles(objectHandle, tag or '')) do
        if not seen[handle] and sim.isHandle(handle) then valid[#valid + 1] = handle end
        seen[handle] = true
    end
    sim.setReferencedHandles(objectHandle, {}, tag or '') -- first: the object may be among those it refers to
    if #valid > 0 then sim.removeObjects(valid, delayed or false) end
end

---------------------------------------------------------------- relative names

local function ancestors(handle)
    local list = {handle}
    while true do
        handle = sim.getObjectParent(handle)
        if handle == -1 then return list end
        list[#list + 1] = handle
    end
end

local function isModel(handle) return sim.getBoolProperty(handle, 'modelBase') end

local function indexOf(list, wanted)
    for i, handle in ipairs(list) do
        if handle == wanted then return i end
    end
end

-- From base up to its ancestor number top: first to the nearest model, if there is one on the way, then in steps.
local function upwards(chain, top)
    local parts, start = {}, 1
    for i = 1, top do
        if isModel(chain[i]) then
            if i > 1 then parts[1], start = ':', i end
            break
        end
    end
    for _ = start + 1, top do parts[#parts + 1] = '..' end
    return parts
end

-- Models on the way down are named, other objects in between are left out: a lookup finds the way without them.
local function downwards(chain, below, aliasOptions)
    local parts = {}
    for i = below - 1, 1, -1 do
        if i == 1 or isModel(chain[i]) then parts[#parts + 1] = sim.getObjectAlias(chain[i], aliasOptions) end
    end
    return parts
end

--- Path from one object to another.
-- @api string path = sim.getObjectAliasRelative(int handle, int baseHandle, int aliasOptions = -1, map options = {})
-- @param handle the object to be named
-- @param baseHandle where the path starts
-- @param aliasOptions as in sim.getObjectAlias, for the parts of the path
-- @return path for sim.getObject with option proxy = baseHandle
function M.getObjectAliasRelative(handle, baseHandle, aliasOptions)
    if handle == baseHandle then return '.' end
    local chain, baseChain = ancestors(handle), ancestors(baseHandle)
    local below, top
    for i, ancestor in ipairs(baseChain) do
        below = indexOf(chain, ancestor)
        if below then
            top = i
            break
        end
    end
    if not below then return sim.getObjectAlias(handle, 1) end
    local parts = upwards(baseChain, top)
    if #parts == 0 then parts[1] = '.' end
    local down = downwards(chain, below, aliasOptions or -1)
    table.move(down, 1, #down, #parts + 1, parts)
    return table.concat(parts, '/')
end

---------------------------------------------------------------- sizes and collections

--- Size of the box around a model.
-- @api float[3] size = sim.getModelBB(int handle)
-- @param handle base of the model
-- @return size along the axes of the base
function M.getModelBB(handle)
    local size = {}
    for i, axis in ipairs{'x', 'y', 'z'} do
        local low = sim.getObjectFloatParam(handle, sim['objfloatparam_modelbbox_min_' .. axis])
        size[i] = sim.getObjectFloatParam(handle, sim['objfloatparam_modelbbox_max_' .. axis]) - low
    end
    return size
end

--- Scales a shape so that its box gets a size.
-- @api sim.setShapeBB(int shapeHandle, float[3] size)
-- @param shapeHandle the shape
-- @param size along the axes of its box
function M.setShapeBB(shapeHandle, size)
    local now, factors = sim.getShapeBB(shapeHandle), {}
    for i = 1, 3 do
        if now[i] < 1e-9 then error('sim.setShapeBB: a flat shape has no thickness to scale; use sim.scaleObject', 2) end
        factors[i] = size[i] / now[i]
    end
    sim.scaleObject(shapeHandle, factors[1], factors[2], factors[3], 0)
end

return M
