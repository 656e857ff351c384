-- topic: properties
-- as: sandbox
-- passes: 0
-- note: all that is read can be written back, and nothing has changed then; bad values of real time are bounded
sim = require 'sim'
local script = sim.createScript(sim.scripttype_customization, 'x = 1', 0, 'lua')
local cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1}, 0)
local targets = {
    {'scene', sim.handle_scene}, {'self', sim.handle_self}, {'dummy', sim.createDummy(0.1)}, {'shape', cube},
    {'mesh', sim.getIntArrayProperty(cube, 'meshes')[1]}, {'script', script},
    {'spherical', sim.createJoint(sim.joint_spherical, sim.jointmode_dynamic, 0)},
    {'revolute', sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)},
    {'force', sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.1, 1, 1, 0, 0})},
    {'cloud', sim.createPointCloud(0.1, 10, 0, 4)}, {'octree', sim.createOctree(0.1, 0, 4)},
}
for _, target in ipairs(targets) do
    local name, handle = table.unpack(target)
    local before = sim.getProperties(handle)
    local ok, why = pcall(sim.setProperties, handle, before)
    local after, changed = sim.getProperties(handle), 0
    for key, value in pairs(before) do
        if sim.packTable({value}) ~= sim.packTable({after[key]}) then changed = changed + 1 print(key, value, after[key]) end
    end
    print(name, ok, why, changed)
end
print(pcall(sim.setFloatProperty, targets[7][2], 'jointPosition', 1.0))
for _, factor in ipairs{0.0, -1.0, math.huge, 1e300} do
    print(pcall(sim.setFloatProperty, sim.handle_scene, 'realtimeModifier', factor))
    print(sim.getFloatProperty(sim.handle_scene, 'realtimeModifier'))
end
