-- topic: creation
-- as: sandbox
-- passes: 0
-- spec: vrep-era 1.2, kinematics 7
-- note: copies and second loads of a model bring its groups of inverse kinematics and its collections; merged shapes keep a name
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function named(get, name)
    local ok, handle = pcall(get, name)
    return ok and handle ~= -1 and handle or nil
end

local arm = sim.createDummy(0.01)
sim.setObjectName(arm, 'UR10')
local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_force, 0)
sim.setObjectName(joint, 'UR10_joint')
sim.setObjectParent(joint, arm, true)
local tip, target = sim.createDummy(0.01), sim.createDummy(0.01)
sim.setObjectName(tip, 'UR10_tip')
sim.setObjectName(target, 'UR10_target')
sim.setObjectParent(tip, joint, true)
sim.setObjectParent(target, arm, true)
sim.setLinkDummy(tip, target)
sim.setModelProperty(arm, 0)
local group = sim.createIkGroup(0, {sim.ik_pseudo_inverse_method, 10})
sim.createIkElement(group, 0, {tip, arm, -1, 1})
local collection = sim.createCollection('UR10_arm', 0)
sim.addObjectToCollection(collection, arm, sim.handle_tree, 0)

for i = 0, 1 do
    local copy = sim.copyPasteObjects({arm}, 1)[1]
    local suffix = '#' .. i
    local copied = named(sim.getIkGroupHandle, 'IK_Group' .. suffix)
    local members = named(sim.getCollectionHandle, 'UR10_arm' .. suffix)
    print(sim.getObjectName(copy), copied, members)
    if members then
        local names = {}
        for k, object in ipairs(sim.getCollectionObjects(members)) do names[k] = sim.getObjectName(object) end
        table.sort(names)
        print(table.concat(names, ' '))
    end
    if copied then print(#select(2, sim.checkIkGroup(copied, {sim.getObjectHandle('UR10_joint' .. suffix)}))) end
end

-- With its model the companions of a copy end, and their numbers are free again.
sim.removeModel(sim.getObjectHandle('UR10#0'))
print('removed', named(sim.getIkGroupHandle, 'IK_Group#0'), named(sim.getCollectionHandle, 'UR10_arm#0'))
print(sim.getObjectName(sim.copyPasteObjects({arm}, 1)[1]), named(sim.getCollectionHandle, 'UR10_arm#0') ~= nil)

-- Merging and grouping keep the name of the last shape.
for _, merge in ipairs{true, false} do
    local shapes = {}
    for i, name in ipairs{'bolt', 'nut#2'} do
        shapes[i] = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}, 0)
        sim.setObjectName(shapes[i], name)
    end
    local shape = sim.groupShapes(shapes, merge)
    print(sim.getObjectName(shape), named(sim.getObjectHandle, 'bolt@silentError'))
    sim.removeObjects{shape}
end
