--[[
Shared by pathmodel.lua: the control points of a path, dummies right below it with the data block ABC_PATHCTRLPT (spec: paths 2).
]]

local sim = _quietRequire 'sim'
local M = {}

local TAG <const> = 'customData.ABC_PATHCTRLPT'
local LAYER <const>, SIZE <const>, PARTS <const> = 4, 0.01, 75

--- The objects right below an object.
function M.children(object)
    local list, child = {}, sim.getObjectChild(object, 0)
    while child >= 0 do
        list[#list + 1] = child
        child = sim.getObjectChild(object, #list)
    end
    return list
end

--- What the data block of a control point holds: index, virtualDist, auxChannels, pathId of a copy. Nil of other objects.
function M.read(object)
    local packed = sim.getBufferProperty(object, TAG, {noError = true})
    local data = packed and #packed > 0 and sim.unpackTable(packed)
    return type(data) == 'table' and tonumber(data.index) and data or nil
end

--- Stores the data block of a control point.
function M.write(object, data)
    data.handle = object
    sim.setBufferProperty(object, TAG, sim.packTable(data))
end

--- The control points of a path in order: tables of handle and what the block holds. A copy of one comes after it.
function M.list(path)
    local found = {}
    for place, child in ipairs(M.children(path)) do
        local data = M.read(child)
        if data then
            data.handle, data.place = child, place
            found[#found + 1] = data
        end
    end
    table.sort(found, function(a, b)
        if a.index ~= b.index then return a.index < b.index end
        return a.place < b.place
    end)
    for _, point in ipairs(found) do point.place = nil end
    return found
end

--- Numbers control points anew, in their order.
function M.number(points)
    for i, point in ipairs(points) do
        if point.index ~= i or point.pathId then
            point.index, point.pathId = i, nil
            M.write(point.handle, point)
        end
    end
end

--- Adds a control point below a path.
function M.add(path, pose, index)
    local point = sim.createDummy(SIZE)
    sim.setObjectAlias(point, 'ctrlPt')
    sim.setObjectParent(point, path, true)
    sim.setObjectPose(point, pose, path)
    sim.setObjectInt32Param(point, sim.objintparam_visibility_layer, LAYER)
    M.write(point, {index = index})
    return point
end

--- Poses in the path's frame, flat.
function M.poses(points, path)
    local poses = {}
    for i, point in ipairs(points) do table.move(sim.getObjectPose(point.handle, path), 1, 7, 7 * i - 6, poses) end
    return poses
end

local function channel(data, i) return tonumber(type(data.auxChannels) == 'table' and data.auxChannels[i]) or 0.0 end

--- Rows of twelve numbers, as sampling.lua wants them.
function M.rows(points, path)
    local poses, rows = M.poses(points, path), {}
    for i, point in ipairs(points) do
        table.move(poses, 7 * i - 6, 7 * i, 12 * i - 11, rows)
        rows[12 * i - 4] = tonumber(point.virtualDist) or 0.0
        for k = 1, 4 do rows[12 * i - 4 + k] = channel(point, k) end
    end
    return rows
end

local function largestExtent(poses)
    local largest = 0.0
    for axis = 1, 3 do
        local low, high = math.huge, -math.huge
        for i = axis, #poses, 7 do low, high = math.min(low, poses[i]), math.max(high, poses[i]) end
        largest = math.max(largest, high - low)
    end
    return largest
end

--- Makes control points as large as their path asks for.
function M.resize(points, poses)
    local size = largestExtent(poses) / PARTS
    if not (size > 0 and size < math.huge) then return end
    for _, point in ipairs(points) do sim.setFloatProperty(point.handle, 'dummySize', size) end
end

--- Shows or hides control points.
function M.show(points, isVisible)
    for _, point in ipairs(points) do
        sim.setObjectInt32Param(point.handle, sim.objintparam_visibility_layer, isVisible and LAYER or 0)
    end
end

return M
