-- Writes odd values to every property of objects of every type, of meshes, the scene and the application, and uses what came of it.
sim = require 'sim'

local TYPES = {
    [0] = 'Bool', 'Int', 'Float', 'String', 'Buffer', 'Vector3', 'Quaternion', 'Pose', [10] = 'Color', [11] = 'FloatArray',
    [12] = 'Table', [13] = 'IntArray', [14] = 'Vector2', [15] = 'IntArray2', [16] = 'Long',
}
local nan, inf = 0 / 0, math.huge
local ODD = {
    true, false, 0, -1, 1, math.maxinteger, math.mininteger, 1e308, -1e308, nan, inf, -inf, 1e-320, '', 'x', '\0\255',
    ('a'):rep(1000), {}, {1}, {nan, nan, nan}, {inf, inf, inf}, {0, 0, 0}, {-1, -1}, {1, 2, 3, 4}, {0, 0, 0, 0, 0, 0, 0},
    {nan, 0, 0, 0, 0, 0, 1}, {1e308, 1e308, 1e308, 0, 0, 0, 1}, {math.maxinteger, math.mininteger}, {'a'}, {1, 'b'},
    {[1] = 1, [3] = 2},
}
-- Left alone: the text of scripts, and what makes the run wait.
local NOT = {code = true, pauseSimulationAtTime = true, pauseSimulationAtError = true, realtimeSimulation = true}

local function objects()
    local found = {
        sim.createDummy(0.1), sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.05, 100, 10, 0, 0}), sim.createOctree(0.05, 0, 1),
        sim.createPointCloud(0.02, 20, 0, 4), sim.createVisionSensor(2), sim.createVisionSensor(0),
        sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3}), sim.createScript(sim.scripttype_passive, '', 0, 'lua'),
    }
    for _, kind in ipairs {sim.joint_revolute, sim.joint_prismatic, sim.joint_spherical} do
        table.insert(found, sim.createJoint(kind, sim.jointmode_dynamic, 0))
    end
    for volume = sim.proximitysensor_pyramid, sim.proximitysensor_ray do
        table.insert(found, sim.createProximitySensor(volume))
    end
    for _, kind in ipairs {sim.sceneobject_camera, sim.sceneobject_light} do
        for _, object in ipairs(sim.getObjectsInTree(sim.handle_scene, kind)) do table.insert(found, object) end
    end
    return found
end

local function names(target)
    local found = {}
    repeat
        local name = sim.getPropertyName(target, #found)
        table.insert(found, name)
    until not name
    return found
end

local function writeAll(target)
    for _, name in ipairs(names(target)) do
        local ty, flags = sim.getPropertyInfo(target, name)
        for _, value in ipairs(NOT[name] and {} or ODD) do
            pcall(sim['set' .. TYPES[ty] .. 'Property'], target, name, value)
        end
        if flags & 2 == 0 then assert(pcall(sim['get' .. TYPES[ty] .. 'Property'], target, name), name) end
    end
end

function sysCall_event(batch) end

function sysCall_init()
    local targets = objects()
    local shape = targets[7]
    local mesh = sim.getIntArrayProperty(shape, 'meshes')[1]
    for _ = 1, 2 do
        for _, target in ipairs(targets) do writeAll(target) end
        writeAll(mesh)
        writeAll(sim.handle_scene)
        writeAll(sim.handle_app)
        for _, target in ipairs(targets) do
            sim.setModelProperty(target, 0)
            sim.getStringProperty(target, 'modelHash')
        end
        sim.scaleObjects(targets, 2, true)
        sim.removeObjects(sim.copyPasteObjects(targets, 0))
    end
    sim.getGenesisEvents()
    print 'every property was written'
end
