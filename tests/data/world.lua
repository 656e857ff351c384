-- Makes world.ttt and part.ttm of this folder: objects of every kind, with what can hang on them. make.sh runs it; check.lua knows what is
-- in them.
sim = require 'sim'
local source, target = sim.getNamedStringParam('source'), sim.getNamedStringParam('target')

-- Cameras, lights and graphs cannot be made by scripts: they come from the file written by hand.
sim.loadScene(source .. '/kinds.simscene.xml')

local function named(object, alias, x)
    sim.setObjectAlias(object, alias)
    if x then sim.setObjectPosition(object, {x, 2, 0.5}) end
    return object
end

local box = named(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3}), 'box', 0)
sim.setShapeMass(box, 3)
sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
sim.setObjectInt32Param(box, sim.shapeintparam_respondable, 1)
sim.setObjectInt32Param(box, sim.shapeintparam_respondable_mask, 0xff00)
sim.setObjectFloatParam(box, sim.shapefloatparam_init_velocity_z, 0.25)
sim.setEngineFloatParam(sim.bullet_body_friction, box, 0.25)
sim.setShapeColor(box, nil, sim.colorcomponent_ambient_diffuse, {1, 0.5, 0})

local mesh = named(sim.createShape(0, 0, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}), 'mesh', 1)
sim.setShapeMass(mesh, 0.5)
local cubes = {}
for i = 1, 3 do
    cubes[i] = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1 * i})
    sim.setObjectPosition(cubes[i], {0.2 * i, 0, 0})
end
named(sim.groupShapes(cubes), 'group', 2)

-- A texture of two by two pixels on two triangles.
local square = sim.createShape(0, 0, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, {0, 1, 2, 0, 2, 3}, nil, {0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 1},
    sim.packUInt8Table({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}), {2, 2})
named(square, 'square', 3)

local motor = named(sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0), 'elbow', 4)
sim.setJointInterval(motor, false, {-1, 2})
sim.setObjectInt32Param(motor, sim.jointintparam_dynctrlmode, sim.jointdynctrl_position)
sim.setJointTargetForce(motor, 12)
sim.setJointTargetPosition(motor, 0.5)
local slider = named(sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0), 'slider', 5)
sim.setJointPosition(slider, 0.25)
local ball = named(sim.createJoint(sim.joint_spherical, sim.jointmode_kinematic, 0), 'ball', 6)
sim.setObjectChildPose(ball, {0, 0, 0, 0, 0, math.sin(0.5), math.cos(0.5)})

local octree = named(sim.createOctree(0.05, 0, 1), 'voxels')
sim.insertVoxelsIntoOctree(octree, 0, {0.01, 0.01, 0.01, 0.51, 0.01, 0.01}, {255, 0, 0}, {7})
local cloud = named(sim.createPointCloud(0.02, 5, 0, 4), 'cloud')
sim.insertPointsIntoPointCloud(cloud, 0, {0, 0, 0, 1, 0, 0, 0, 1, 0})

local graph = sim.getObject('/graph')
local stream = sim.addGraphStream(graph, 'height', 'm', 0, {1, 0, 0}, 0)
for i = 1, 3 do
    sim.setGraphStreamValue(graph, stream, i * i)
    sim.handleGraph(graph, 0.1 * i)
end

-- Custom data of every type, on an object and on the scene.
sim.writeCustomStringData(box, 'bytes', 'a\0b')
sim.writeCustomTableData(box, 'table', {1, 'two', deep = {true, 2.5}})
for _, target in ipairs {box, sim.handle_scene} do
    sim.setIntProperty(target, 'customData.int', 7)
    sim.setLongProperty(target, 'customData.long', 1 << 40)
    sim.setFloatProperty(target, 'customData.float', 0.1)
    sim.setBoolProperty(target, 'customData.bool', true)
    sim.setStringProperty(target, 'customData.string', 'text')
    sim.setFloatArrayProperty(target, 'customData.floats', {1.5, 2.5})
    sim.setTableProperty(target, 'customData.map', {a = 1, b = {2, 3}})
end
sim.setReferencedHandles(box, {mesh, octree}, 'friends')
sim.setExplicitHandling(sim.getObject('/vision'), 1)

local function script(kind, parent, text)
    local object = sim.createScript(kind, text, 0, 'lua')
    sim.setObjectParent(object, parent, true)
end
script(sim.scripttype_simulation, box, "function sysCall_init()\n    sim = require 'sim'\n    seen = 'simulation'\nend\n")
script(sim.scripttype_customization, mesh, "function sysCall_init()\n    sim = require 'sim'\n    seen = 'customization'\nend\n")

sim.setObjectParent(slider, box, true)
sim.setModelProperty(box, 0)
sim.saveModel(box, target .. '/part.ttm')
sim.saveScene(target .. '/world.ttt')
