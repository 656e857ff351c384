--[[
Entities of the standard simulation interfaces of ROS 2: objects without a parent that are models or shapes. Their names are those of the
objects. Named poses are dummies without a parent and children. Internal.
]]

local sim = require('sim')
local simROS2 = require('simROS2')
local results = require('remote.ros2.results')

local M = {}

local ROBOT <const>, DYNAMIC <const>, STATIC <const> = 1, 4, 5
local BOX <const>, SPHERE <const> = 1, 3
local INVALID_POSE <const> = 101
local INFO <const> = 'customData.simulationInterfaces'
local TOLERANCE <const> = 1e-3 -- of the length of a quaternion

---------------------------------------------------------------- which there are

local function isModel(object) return sim.getModelProperty(object) & sim.modelproperty_not_model == 0 end

local function isEntity(object)
    local kind = sim.getObjectType(object)
    return kind == sim.sceneobject_shape or kind ~= sim.sceneobject_script and isModel(object)
end

M.isEntity = isEntity

local function isNamedPose(object)
    return sim.getObjectType(object) == sim.sceneobject_dummy and not isModel(object) and sim.getObjectChild(object, 0) == -1
end

local function roots(isWanted)
    local found = {}
    for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene)) do
        if sim.getObjectParent(object) == -1 and isWanted(object) then found[#found + 1] = object end
    end
    return found
end

function M.name(object) return (sim.getObjectAlias(object, 2):gsub('^/', '')) end

local function find(name, isWanted)
    for _, object in ipairs(roots(isWanted)) do
        if M.name(object) == name then return object end
    end
end

--- The object of an entity; nil if there is none of that name.
function M.find(name) return find(name, isEntity) end

---------------------------------------------------------------- poses

local function point(x, y, z) return {x = x, y = y, z = z} end

local function poseMessage(object)
    local p = sim.getObjectPose(object)
    return {position = point(p[1], p[2], p[3]), orientation = {x = p[4], y = p[5], z = p[6], w = p[7]}}
end

local function isFinite(numbers)
    for _, number in ipairs(numbers) do
        if number ~= number or math.abs(number) == math.huge then return false end
    end
    return true
end

--- The pose of a message in the world; nil and why it is none. The frame is the world's or an entity's.
function M.pose(message, frame)
    local p, q = message.position, message.orientation
    local pose = {p.x, p.y, p.z, q.x, q.y, q.z, q.w}
    local length = math.sqrt(q.x ^ 2 + q.y ^ 2 + q.z ^ 2 + q.w ^ 2)
    if not isFinite(pose) then return nil, 'the pose has numbers that are not finite' end
    if math.abs(length - 1) > TOLERANCE then return nil, ('the orientation is no unit quaternion: its length is %g'):format(length) end
    if frame == '' or frame == 'world' then return pose end
    local object = M.find(frame)
    if not object then return nil, ("the frame '%s' is neither 'world' nor an entity"):format(frame) end
    return sim.multiplyPoses(sim.getObjectPose(object), pose)
end

---------------------------------------------------------------- bounds

-- Two corners in the frame of the object: of the whole model, or of the shape.
local function box(object)
    local first = isModel(object) and 21 or 15
    local numbers = {}
    for i = 0, 5 do numbers[i + 1] = sim.getObjectFloatParam(object, first + i) or 0 end
    return numbers
end

-- The box with the world's axes around that box.
local function worldBox(object)
    local low, high = {math.huge, math.huge, math.huge}, {-math.huge, -math.huge, -math.huge}
    local b, matrix = box(object), sim.getObjectMatrix(object)
    for corner = 0, 7 do
        local at = {}
        for axis = 1, 3 do at[axis] = b[corner >> (axis - 1) & 1 == 0 and axis or axis + 3] end
        at = sim.multiplyVector(matrix, at)
        for axis = 1, 3 do low[axis], high[axis] = math.min(low[axis], at[axis]), math.max(high[axis], at[axis]) end
    end
    return low, high
end

local function axes(vector) return {vector.x, vector.y, vector.z} end

-- Whether something with these bounds overlaps a box.
local OVERLAPS <const> = {
    [BOX] = function(low, high, points)
        local a, b = axes(points[1]), axes(points[2])
        for axis = 1, 3 do
            if math.max(a[axis], b[axis]) < low[axis] or math.min(a[axis], b[axis]) > high[axis] then return false end
        end
        return true
    end,
    [SPHERE] = function(low, high, points)
        local centre, radius, square = axes(points[1]), points[2].x, 0
        for axis = 1, 3 do
            local nearest = math.max(low[axis], math.min(high[axis], centre[axis]))
            square = square + (centre[axis] - nearest) ^ 2
        end
        return square <= radius ^ 2
    end,
}

function M.bounds(request)
    local object = M.find(request.entity)
    if not object then return results.notFound('entity', request.entity) end
    local b = box(object)
    return results.ok {bounds = {type = BOX, points = {point(b[1], b[2], b[3]), point(b[4], b[5], b[6])}}}
end

---------------------------------------------------------------- what is known of them

local function isDynamic(object)
    return sim.getObjectType(object) == sim.sceneobject_shape and sim.getObjectInt32Param(object, sim.shapeintparam_static) == 0
end

local function category(object)
    if #sim.getObjectsInTree(object, sim.sceneobject_joint) > 0 then return ROBOT end
    return isDynamic(object) and DYNAMIC or STATIC
end

local function infoOf(object)
    local packed = sim.getBufferProperty(object, INFO, {noError = true})
    if packed and #packed > 0 then return sim.unpackTable(packed) end
    return {category = {category = category(object)}, description = '', tags = {}}
end

function M.setInfoOf(object, info) sim.setBufferProperty(object, INFO, sim.packTable(info)) end

M.infoOf = infoOf

function M.info(request)
    local object = M.find(request.entity)
    if not object then return results.notFound('entity', request.entity) end
    local info = infoOf(object)
    return results.ok {info = {category = info.category, description = info.description, tags = info.tags}}
end

function M.setInfo(request)
    local object = M.find(request.entity)
    if not object then return results.notFound('entity', request.entity) end
    local info = infoOf(object)
    info.category, info.description, info.tags = request.info.category, request.info.description, request.info.tags
    M.setInfoOf(object, info)
    return results.ok()
end

---------------------------------------------------------------- lists

local function hasCategory(info, categories)
    for _, one in ipairs(categories) do
        if one.category == info.category.category then return true end
    end
    return #categories == 0
end

-- The objects that pass all filters; nil and why a filter cannot be used.
local function filtered(filters)
    local overlaps = OVERLAPS[filters.bounds.type]
    if filters.bounds.type ~= 0 and (not overlaps or #filters.bounds.points ~= 2) then
        return nil, 'entities are restricted by a box or a sphere, of two points'
    end
    if M.matches(filters.filter, '') == nil then return nil, ("'%s' is no regular expression"):format(filters.filter) end
    local kept = {}
    for _, object in ipairs(roots(isEntity)) do
        local info = infoOf(object)
        local passes = M.matches(filters.filter, M.name(object)) and hasCategory(info, filters.categories)
            and results.passTags(info.tags, filters.tags)
        if passes and overlaps then
            local low, high = worldBox(object)
            passes = overlaps(low, high, filters.bounds.points)
        end
        if passes then kept[#kept + 1] = object end
    end
    return kept
end

local function stateOf(object)
    local linear, angular = sim.getObjectVelocity(object | sim.handleflag_axis)
    if isDynamic(object) and sim.getSimulationState() ~= sim.simulation_stopped then linear, angular = sim.getVelocity(object) end
    return {
        header = {stamp = simROS2.getSimulationTime(), frame_id = 'world'},
        pose = poseMessage(object),
        twist = {linear = point(table.unpack(linear)), angular = point(table.unpack(angular))},
    }
end

function M.list(request)
    local objects, reason = filtered(request.filters)
    if not objects then return results.failed(results.OPERATION_FAILED, reason) end
    local names = {}
    for i, object in ipairs(objects) do names[i] = M.name(object) end
    return results.ok {entities = names}
end

function M.listStates(request)
    local objects, reason = filtered(request.filters)
    if not objects then return results.failed(results.OPERATION_FAILED, reason) end
    local names, states = {}, {}
    for i, object in ipairs(objects) do names[i], states[i] = M.name(object), stateOf(object) end
    return results.ok {entities = names, states = states}
end

function M.state(request)
    local object = M.find(request.entity)
    if not object then return results.notFound('entity', request.entity) end
    return results.ok {state = stateOf(object)}
end

---------------------------------------------------------------- changes

local INITIAL <const> = {
    sim.shapefloatparam_init_velocity_x, sim.shapefloatparam_init_velocity_y, sim.shapefloatparam_init_velocity_z,
    sim.shapefloatparam_init_velocity_a, sim.shapefloatparam_init_velocity_b, sim.shapefloatparam_init_velocity_g,
}
local initial = {} -- the initial velocities of shapes whose twist was set, until the next step

local function velocities(object)
    local linear, angular = sim.getVelocity(object)
    return table.move(angular, 1, 3, 4, linear)
end

-- Six numbers: m/s and rad/s along the axes of the world.
local function setTwist(object, numbers)
    local before = {}
    for i, id in ipairs(INITIAL) do
        before[i] = sim.getObjectFloatParam(object, id)
        sim.setObjectFloatParam(object, id, numbers[i])
    end
    initial[object] = initial[object] or before
end

--- A step has been made: twists that were set have taken effect, and are not those of the next start.
function M.afterStep()
    for object, before in pairs(initial) do
        for i, id in ipairs(INITIAL) do
            if sim.isHandle(object) then sim.setObjectFloatParam(object, id, before[i]) end
        end
    end
    initial = {}
end

function M.setState(request)
    local object = M.find(request.entity)
    if not object then return results.notFound('entity', request.entity) end
    if request.set_acceleration then
        return results.failed(results.FEATURE_UNSUPPORTED, 'accelerations follow from forces: set the pose or the twist')
    end
    if request.set_twist and not isDynamic(object) then
        return results.failed(results.OPERATION_FAILED, ("'%s' is static, so it has no twist"):format(request.entity))
    end
    local pose, reason = M.pose(request.state.pose, request.state.header.frame_id)
    if request.set_pose and not pose then return results.failed(INVALID_POSE, reason) end
    local moves = isDynamic(object) and sim.getSimulationState() ~= sim.simulation_stopped
    local twist = moves and velocities(object)
    if request.set_twist then
        local linear, angular = request.state.twist.linear, request.state.twist.angular
        twist = {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z}
        if not isFinite(twist) then return results.failed(results.OPERATION_FAILED, 'the twist has numbers that are not finite') end
    end
    if request.set_pose then sim.setObjectPose(object, pose) end
    if twist then setTwist(object, twist) end
    -- The physics begins anew with it, at these velocities.
    sim.resetDynamicObject(object | sim.handleflag_model)
    return results.ok()
end

--- Removes an entity with all that belongs to it.
function M.remove(object) sim.removeObjects(sim.getObjectsInTree(object)) end

function M.delete(request)
    local object = M.find(request.entity)
    if not object then return results.notFound('entity', request.entity) end
    M.remove(object)
    return results.ok()
end

---------------------------------------------------------------- named poses

function M.namedPoses(request)
    local poses = {}
    for _, object in ipairs(roots(isNamedPose)) do
        local info = infoOf(object)
        if results.passTags(info.tags, request.tags) then
            poses[#poses + 1] = {name = M.name(object), description = info.description, tags = info.tags, pose = poseMessage(object)}
        end
    end
    return results.ok {poses = poses}
end

function M.namedPoseBounds(request)
    if not find(request.name, isNamedPose) then return results.notFound('named pose', request.name) end
    return results.ok {bounds = {type = 0, points = {}}}
end

return M
