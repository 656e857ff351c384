--[[
Shared by the scripts of conveyors: pads and rollers, which carry what lies on a conveyor, and boxes beside it. Parts have a data block, so that they are found again.
]]

local sim = _quietRequire 'sim'
local M = {}

local PAD <const>, ROLLER <const> = 'PATHPAD', 'PATHROL'
local MASS <const>, ROLLER_LAYER <const> = 0.01, 512
local MAX_PARTS <const> = 10000 -- parts; more are a mistake in the settings
local TYPES <const> = {0, 0, 0, 2, 2, 2, 2}

local function belongs(object, tag, value)
    local data = sim.getBufferProperty(object, 'customData.' .. tag, {noError = true})
    return data and tostring(data) == value
end

--- The parts of a kind: 'a' pads, 'b' respondable parts, 'c' borders of PATHPAD; 'a' of PATHROL.
function M.find(model, tag, value)
    local found, i = {}, 0
    while true do
        local child = sim.getObjectChild(model, i)
        if child < 0 then return found end
        if belongs(child, tag, value) then found[#found + 1] = child end
        i = i + 1
    end
end

function M.pads(model) return M.find(model, PAD, 'a') end

function M.rollers(model) return M.find(model, ROLLER, 'a') end

-- Whole trees: rollers are below their joints.
local function removeTrees(objects)
    local all = {}
    for _, object in ipairs(objects) do
        for _, part in ipairs(sim.getObjectsInTree(object)) do all[#all + 1] = part end
    end
    if #all > 0 then sim.removeObjects(all) end
end

--- Removes what `M.addPad` and its kin have made.
function M.clear(model)
    for _, kind in ipairs{{PAD, 'a'}, {PAD, 'b'}, {PAD, 'c'}, {ROLLER, 'a'}} do removeTrees(M.find(model, table.unpack(kind))) end
end

local function finish(shape, colour, isRespondable)
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, colour)
    sim.setBoolProperty(shape, 'dynamic', false)
    sim.setBoolProperty(shape, 'respondable', isRespondable)
    sim.setBoolProperty(shape, 'kinematic', isRespondable)
    sim.setObjectProperty(shape, sim.getObjectProperty(shape) | sim.objectproperty_selectmodelbaseinstead)
end

--- Adds a pad.
-- @param sizes along the belt, across it, thickness
-- @param layer visibility layer, default 1
function M.addPad(model, sizes, colour, isRespondable, layer)
    local pad = sim.createPrimitiveShape(sim.primitiveshape_cuboid, sizes, 0)
    sim.setObjectAlias(pad, 'pad')
    sim.setShapeMass(pad, MASS)
    finish(pad, colour, isRespondable)
    if layer then sim.setObjectInt32Param(pad, sim.objintparam_visibility_layer, layer) end
    sim.setObjectParent(pad, model, false)
    sim.setBufferProperty(pad, 'customData.' .. PAD, 'a')
    return pad
end

--- Adds a roller: a joint and a cylinder that turns with it.
-- @param pose of the joint in the model's frame; it turns around z
function M.addRoller(model, pose, radius, width, colour, isRespondable)
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0, {width, radius / 5})
    sim.setObjectAlias(joint, 'jrol')
    sim.setObjectInt32Param(joint, sim.objintparam_visibility_layer, ROLLER_LAYER)
    sim.setObjectParent(joint, model, false)
    sim.setObjectPose(joint, pose, model)
    sim.setBufferProperty(joint, 'customData.' .. ROLLER, 'a')
    local roller = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {2 * radius, 2 * radius, 0.95 * width}, 0)
    sim.setObjectAlias(roller, 'rol')
    sim.setShapeMass(roller, MASS)
    finish(roller, colour, isRespondable)
    sim.setObjectParent(roller, joint, false)
    return joint
end

--- One static shape of boxes.
-- @param boxes tables of pose, in the model's frame, and sizes
-- @param value kind of PATHPAD: 'b' or 'c'
function M.addBoxes(model, boxes, alias, value, colour, layer)
    local made = {}
    for i, box in ipairs(boxes) do
        made[i] = sim.createPrimitiveShape(sim.primitiveshape_cuboid, box.sizes, 0)
        sim.setObjectPose(made[i], sim.multiplyPoses(sim.getObjectPose(model), box.pose))
    end
    if #made == 0 then return end
    local shape = #made > 1 and sim.groupShapes(made) or made[1]
    sim.setObjectAlias(shape, alias)
    finish(shape, colour, true)
    sim.setBoolProperty(shape, 'kinematic', false)
    sim.setObjectInt32Param(shape, sim.objintparam_visibility_layer, layer)
    sim.setObjectParent(shape, model, true)
    sim.setBufferProperty(shape, 'customData.' .. PAD, value)
end

--- A number of parts, at least one.
function M.checkedCount(count)
    if not (count <= MAX_PARTS) then error(('the settings ask for more than %d parts'):format(MAX_PARTS), 0) end
    return math.max(1, math.floor(count))
end

--- The colour of a setting; grey where it is none.
function M.colour(value)
    local isColour = type(value) == 'table' and tonumber(value[1]) and tonumber(value[2]) and tonumber(value[3])
    return isColour and value or {0.2, 0.2, 0.2}
end

---------------------------------------------------------------- ways

--- A way along poses: `at(s)` is the pose at the distance s, `length` its length.
-- @param poses flat, seven numbers each
-- @param height how far away from the poses, along their z axes; distances are those along the poses
function M.way(poses, height)
    local lengths, length = sim.getPathLengths(poses, 7)
    local moved = poses
    if height ~= 0 then
        moved = {}
        for i = 1, #poses, 7 do
            local pose = table.move(poses, i, i + 6, 1, {})
            table.move(sim.multiplyPoses(pose, {0, 0, height, 0, 0, 0, 1}), 1, 7, i, moved)
        end
    end
    return {length = length, at = function(s) return sim.getPathInterpolatedConfig(moved, lengths, s, nil, TYPES) end}
end

--- Whether two tables of settings are equal; numbers are compared as they are.
function M.same(a, b)
    if type(a) ~= 'table' or type(b) ~= 'table' then return a == b end
    for key, part in pairs(a) do
        if not M.same(part, b[key]) then return false end
    end
    for key in pairs(b) do
        if a[key] == nil then return false end
    end
    return true
end

--- Whether a model was made with these settings; `tag` names the data block.
function M.isMadeWith(model, tag, config)
    local packed = sim.readCustomBufferData(model, tag)
    return packed and #packed > 0 and M.same(sim.unpackTable(packed), config) or false
end

--- Notes the settings a model was made with.
function M.noteSettings(model, tag, config) sim.writeCustomBufferData(model, tag, sim.packTable(config)) end

return M
