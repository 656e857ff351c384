--[[
What pages change in a scene. Each function takes a table of arguments and returns what it did: `label`, for undo and redo, and
`selection`, the objects that are selected then (unchanged without).

It lives in the sandbox as a module that scripts do not see by name.
]]

local sim = require 'sim'
local M = {}

local function alias(handle) return sim.getObjectAlias(handle, -1) end

-- One name, or how many there are.
local function named(handles)
    return #handles == 1 and alias(handles[1]) or #handles .. ' objects'
end

-- The objects that an edit is about, which have to be there.
local function objects(args)
    if type(args.handles) ~= 'table' or #args.handles == 0 then error('`handles` is a list of objects', 0) end
    for _, handle in ipairs(args.handles) do
        if not sim.isHandle(handle) then error('there is no object with handle ' .. tostring(handle), 0) end
    end
    return args.handles
end

local function isScript(handle) return sim.getObjectType(handle) == sim.sceneobject_script end

local function parentOf(handle) return sim.getObjectParent(handle) end

local function without(list, unwanted)
    local kept = {}
    for _, each in ipairs(list) do if not unwanted[each] then kept[#kept + 1] = each end end
    return kept
end

-- Those of the handles that are not below another one of them.
local function tops(handles)
    local below = {}
    for _, handle in ipairs(handles) do
        for _, each in ipairs(sim.getObjectsInTree(handle, sim.handle_all, 1)) do below[each] = true end
    end
    return without(handles, below)
end

---------------------------------------------------------------- placing

--- Puts objects at poses of the world.
function M.move(args)
    for i, handle in ipairs(objects(args)) do sim.setObjectPose(handle, args.poses[i], sim.handle_world) end
    return {label = 'Move ' .. named(args.handles)}
end

local dragged = {} -- poses at the beginning of the gesture that goes on, by handle

local function startPoses(args)
    if dragged.gesture ~= args.gesture then
        dragged = {gesture = args.gesture}
        for _, handle in ipairs(objects(args)) do dragged[handle] = sim.getObjectPose(handle, sim.handle_world) end
    end
    return dragged
end

local IDENTITY <const> = {0, 0, 0, 0, 0, 0, 1}

-- The frame whose axes a drag goes along: at the object, turned as the world, its parent, or itself.
local function frameOf(handle, start, kind)
    local above = kind == 'parent' and sim.getObjectParent(handle) or -1
    local turned = kind == 'own' and start or above ~= -1 and sim.getObjectPose(above, sim.handle_world) or IDENTITY
    return {start[1], start[2], start[3], turned[4], turned[5], turned[6], turned[7]}
end

-- A turn about an axis as a pose without position.
local function turnPose(turn)
    local s = math.sin(turn[4] / 2)
    return {0, 0, 0, turn[1] * s, turn[2] * s, turn[3] * s, math.cos(turn[4] / 2)}
end

--- Moves objects as one body from where they were when the gesture began: `by` metres and a `turn` (axis and angle) in the `frame` of the
--- object `active`: 'world', 'parent' or 'own' axes.
function M.drag(args)
    local starts = startPoses(args)
    local frame = frameOf(args.active, starts[args.active], args.frame)
    local by, turn = args.by or {0, 0, 0}, turnPose(args.turn or {0, 0, 1, 0})
    local motion = {by[1], by[2], by[3], turn[4], turn[5], turn[6], turn[7]}
    local inWorld = sim.multiplyPoses(sim.multiplyPoses(frame, motion), sim.getPoseInverse(frame))
    for _, handle in ipairs(tops(objects(args))) do
        sim.setObjectPose(handle, sim.multiplyPoses(inWorld, starts[handle]), sim.handle_world)
    end
    return {label = (args.turn and 'Turn ' or 'Move ') .. named(args.handles)}
end

-- The lowest point of a shape's bounding box, in the world.
local function bottomOfShape(handle)
    local size, frame = sim.getShapeBB(handle)
    local matrix = sim.poseToMatrix(sim.multiplyPoses(sim.getObjectPose(handle, sim.handle_world), frame))
    local reach = math.abs(matrix[9]) * size[1] + math.abs(matrix[10]) * size[2] + math.abs(matrix[11]) * size[3]
    return matrix[12] - reach / 2
end

-- The lowest point of an object with all below it; nil without a shape.
local function bottom(handle)
    local low
    for _, each in ipairs(sim.getObjectsInTree(handle, sim.sceneobject_shape)) do
        local z = bottomOfShape(each)
        low = math.min(low or z, z)
    end
    return low
end

local function lift(handle, by)
    local pose = sim.getObjectPose(handle, sim.handle_world)
    pose[3] = pose[3] + by
    sim.setObjectPose(handle, pose, sim.handle_world)
end

local CLOSE <const> = 1e-5 -- metres between an object and what it lies on

-- The distance to the nearest shape that is not part of the object; huge without one.
local function distance(own, others)
    if others == -1 then return math.huge end
    local found, data = sim.checkDistance(own, others, 0)
    return found == 1 and data[7] or math.huge
end

-- Lowers an object until it touches something, or the plane z = 0.
local function lower(handle, own, others)
    for _ = 1, 200 do
        local z = bottom(handle)
        local free = math.min(distance(own, others), z > 0 and z or math.huge)
        if free == math.huge or free < CLOSE then return end
        lift(handle, -free)
    end
end

-- All shapes outside of a tree, as a collection; -1 without any.
local function othersThan(handle)
    local own = {}
    for _, each in ipairs(sim.getObjectsInTree(handle)) do own[each] = true end
    local others = without(sim.getObjectsInTree(sim.handle_scene, sim.sceneobject_shape), own)
    if #others == 0 then return -1 end
    local collection = sim.createCollection()
    for _, each in ipairs(others) do sim.addItemToCollection(collection, sim.handle_single, each, 0) end
    return collection
end

local function drop(handle)
    if not bottom(handle) then error(alias(handle) .. ' has no shape that could rest on something', 0) end
    local own, others = sim.createCollection(), othersThan(handle)
    sim.addItemToCollection(own, sim.handle_tree, handle, 0)
    lower(handle, own, others)
    sim.destroyCollection(own)
    if others ~= -1 then sim.destroyCollection(others) end
end

--- Lowers objects onto what is below them.
function M.drop(args)
    for _, handle in ipairs(tops(objects(args))) do drop(handle) end
    return {label = 'Drop ' .. named(args.handles)}
end

--- Scales a shape so that its bounding box has a size; extents that are zero stay so.
function M.resize(args)
    local before, factors = sim.getShapeBB(args.handle), {}
    for i, wanted in ipairs(args.size) do
        if not (wanted > 0) and before[i] > 0 then error('sizes are above zero', 0) end
        factors[i] = before[i] > 0 and wanted / before[i] or 1
    end
    sim.scaleObject(args.handle, factors[1], factors[2], factors[3])
    return {label = 'Resize ' .. alias(args.handle)}
end

---------------------------------------------------------------- the tree

function M.rename(args)
    local before = alias(args.handle)
    sim.setObjectAlias(args.handle, args.alias)
    return {label = ('Rename %s to %s'):format(before, alias(args.handle))}
end

--- Removes objects with all that is below them.
function M.remove(args)
    local label = 'Delete ' .. named(objects(args))
    local all = {}
    for _, handle in ipairs(tops(objects(args))) do
        for _, each in ipairs(sim.getObjectsInTree(handle)) do all[#all + 1] = each end
    end
    sim.removeObjects(all)
    return {label = label, selection = {}}
end

-- How far copies stand aside, so that they are seen.
local function width(handle)
    local widest = 0
    for _, each in ipairs(sim.getObjectsInTree(handle, sim.sceneobject_shape)) do
        local size = sim.getShapeBB(each)
        widest = math.max(widest, size[1], size[2])
    end
    return widest > 0 and widest * 1.2 or 0.1
end

--- Copies objects with all that is below them, beside them.
function M.duplicate(args)
    local originals, copies = tops(objects(args)), {}
    for i, handle in ipairs(originals) do
        local tree = sim.getObjectsInTree(handle)
        copies[i] = sim.copyPasteObjects(tree, 0)[1]
        local pose = sim.getObjectPose(handle, sim.handle_world)
        pose[1] = pose[1] + width(handle)
        sim.setObjectParent(copies[i], parentOf(handle), true)
        if not isScript(copies[i]) then sim.setObjectPose(copies[i], pose, sim.handle_world) end
    end
    return {label = 'Duplicate ' .. named(originals), selection = copies}
end

--- Puts objects below another one, or below none (-1), where they are.
function M.parent(args)
    for _, handle in ipairs(tops(objects(args))) do sim.setObjectParent(handle, args.parent, true) end
    local where = args.parent == -1 and 'to the top' or 'below ' .. alias(args.parent)
    return {label = ('Move %s %s'):format(named(args.handles), where)}
end

--- Shapes become one compound shape.
function M.group(args)
    local group = sim.groupShapes(objects(args))
    return {label = 'Group ' .. #args.handles .. ' shapes', selection = {group}}
end

--- A compound shape becomes its parts.
function M.ungroup(args)
    local label, parts = 'Ungroup ' .. alias(args.handle), sim.ungroupShape(args.handle)
    return {label = label, selection = parts}
end

--- An object with all below it becomes a model, or none.
function M.model(args)
    sim.setBoolProperty(args.handle, 'modelBase', args.on)
    return {label = (args.on and '%s becomes a model' or '%s is no model'):format(alias(args.handle))}
end

---------------------------------------------------------------- new objects

local TEMPLATE <const> = [[sim = require 'sim'

function sysCall_init()
    -- once, when the simulation begins
end

function sysCall_actuation()
    -- in each step, before it
end

function sysCall_sensing()
    -- in each step, after it
end
]]

local function shape(kind, size)
    return function(args)
        local handle = sim.createPrimitiveShape(kind, args.size or size, 0)
        sim.setBoolProperty(handle, 'dynamic', args.dynamic ~= false)
        sim.setBoolProperty(handle, 'respondable', args.dynamic ~= false)
        sim.computeMassAndInertia(handle, 1000)
        return handle
    end
end

local function joint(kind)
    return function() return sim.createJoint(kind, sim.jointmode_dynamic, 0, {0.1, 0.02}) end
end

-- A sensor of a range (metres); a cone has an angle.
local function proximity(volume, angle)
    return function()
        local params = {0, 0.5, 0, 0, 0, 0, 0, 0, 0, angle, 0, 0, 0.01, 0, 0}
        return sim.createProximitySensor(volume, 16, 0, {32, 32, 1, 16, 1, 1, 0, 0}, params)
    end
end

local function vision()
    local angle = math.rad(60)
    return sim.createVisionSensor(2, {256, 256, 0, 0}, {0.01, 10, angle, 0.05, 0, 0, 0.2, 0.2, 0.2, 0, 0})
end

local function script(kind)
    return function() return sim.createScript(kind, TEMPLATE, 0) end
end

local kinds = {
    cuboid = shape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}),
    sphere = shape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1}),
    cylinder = shape(sim.primitiveshape_cylinder, {0.1, 0.1, 0.1}),
    cone = shape(sim.primitiveshape_cone, {0.1, 0.1, 0.1}),
    capsule = shape(sim.primitiveshape_capsule, {0.05, 0.05, 0.15}),
    plane = shape(sim.primitiveshape_plane, {1, 1, 0}),
    revoluteJoint = joint(sim.joint_revolute),
    prismaticJoint = joint(sim.joint_prismatic),
    sphericalJoint = joint(sim.joint_spherical),
    dummy = function() return sim.createDummy(0.02) end,
    forceSensor = function() return sim.createForceSensor(0, {0, 0, 0, 0, 0}, {0.02, 0, 0, 0, 0}) end,
    raySensor = proximity(sim.proximitysensor_ray, 0),
    coneSensor = proximity(sim.proximitysensor_cone, math.rad(30)),
    visionSensor = vision,
    simulationScript = script(sim.scripttype_simulation),
    customizationScript = script(sim.scripttype_customization),
}

-- The pose of what is new: a shape stands on the place that is given, another object is at it.
local function place(handle, args)
    local where = args.position or {0, 0, 0}
    sim.setObjectPose(handle, {where[1], where[2], where[3], 0, 0, 0, 1}, sim.handle_world)
    local low = bottom(handle)
    if low then lift(handle, where[3] - low) end
end

-- Puts what is new below an object, at it; or at a place of the world.
local function attach(handle, args)
    local isBelow = args.parent and args.parent ~= -1
    if isBelow then sim.setObjectParent(handle, args.parent, false) end
    if isScript(handle) then return end
    if isBelow then sim.setObjectPose(handle, IDENTITY, args.parent) else place(handle, args) end
end

--- An object that is there already is one of the scene's now: see `add`.
function M.adopt(args)
    attach(args.handle, args)
    return {label = 'Add ' .. alias(args.handle), selection = {args.handle}}
end

--- A new object of a kind, below an object and at it, or at a place of the world.
function M.add(args)
    local make = kinds[args.kind] or error('there is no kind of object ' .. tostring(args.kind), 0)
    return M.adopt({handle = make(args), parent = args.parent, position = args.position})
end

--- The shape of a mesh file.
function M.importMesh(args)
    sim.importShape(0, args.path, 16, 0, 1)
    return {}
end

--- What has come from a file stands where it was dropped.
function M.loaded(args)
    for _, handle in ipairs(args.handles) do
        if args.position and not isScript(handle) then
            local pose = sim.getObjectPose(handle, sim.handle_world)
            pose[1], pose[2] = args.position[1], args.position[2]
            sim.setObjectPose(handle, pose, sim.handle_world)
        end
    end
    return {label = 'Load ' .. args.name, selection = args.handles}
end

---------------------------------------------------------------- forces

local PULL_FREQUENCY <const> = 8 -- rad/s, of a spring with critical damping: moderate beside a simulation step of 50 ms

-- The mass that a pull has to move: that of all dynamic shapes of the tree.
local function pulledMass(handle)
    local top = handle
    while sim.getObjectParent(top) ~= -1 do top = sim.getObjectParent(top) end
    local mass = 0
    for _, each in ipairs(sim.getObjectsInTree(top, sim.sceneobject_shape)) do
        if sim.getBoolProperty(each, 'dynamic') then mass = mass + sim.getFloatProperty(each, 'mass') end
    end
    return mass
end

-- The shape that moves when one pulls at an object: itself, or the first one above it that is dynamic.
local function pulledShape(handle)
    local at = handle
    while at ~= -1 do
        if sim.getObjectType(at) == sim.sceneobject_shape and sim.getBoolProperty(at, 'dynamic') then return at end
        at = sim.getObjectParent(at)
    end
    error(alias(handle) .. ' is static: only dynamic shapes can be pulled', 0)
end

-- A spring with critical damping, from a point of a body to a target: the force on the body.
local function springForce(mass, point, velocity, target)
    local force = {}
    for i = 1, 3 do
        force[i] = mass * (PULL_FREQUENCY ^ 2 * (target[i] - point[i]) - 2 * PULL_FREQUENCY * velocity[i])
    end
    return force
end

local function cross(a, b)
    return {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]}
end

local function sum(a, b) return {a[1] + b[1], a[2] + b[2], a[3] + b[3]} end

--- Pulls a point of an object (in its frame) towards a place of the world, during the next step. The force, newtons.
function M.pull(args)
    local point = sim.multiplyVector(sim.getObjectPose(args.handle, sim.handle_world), args.point)
    local body = pulledShape(args.handle)
    local centre = sim.multiplyVector(sim.getObjectPose(body, sim.handle_world), sim.getVector3Property(body, 'centerOfMass'))
    local arm = {point[1] - centre[1], point[2] - centre[2], point[3] - centre[3]}
    local velocity, turning = sim.getVelocity(body)
    local force = springForce(pulledMass(body), point, sum(velocity, cross(turning, arm)), args.target)
    sim.addForceAndTorque(body, force, cross(arm, force))
    return {force = force, body = body, point = point}
end

-- An error of a call from outside would be one of the sandbox's: it is a result instead.
local guarded = {}
for name, f in pairs(M) do
    guarded[name] = function(args)
        local done, result = pcall(f, args)
        return done and result or {failed = tostring(result)}
    end
end

package.loaded.swanilda_edits = guarded
