-- topic: objects
-- as: sandbox
-- passes: 0
-- spec: shapes 8
-- note: what newer recordings of the original say about colours of compounds, textures, paths, dependent joints and collections
sim = require 'sim'
local function list(t) local r = {} for i, x in ipairs(t) do r[i] = string.format('%g', x) end return table.concat(r, ' ') end
local a, b = sim.createPrimitiveShape(3, {1, 1, 1}), sim.createPrimitiveShape(3, {1, 1, 1})
sim.setShapeColor(a, nil, 0, {0, 1, 0})
sim.setShapeColor(b, nil, 0, {0, 0, 1})
local g = sim.groupShapes({a, b})
print('nil', list(select(2, sim.getShapeColor(g, nil, 0))))
sim.setShapeColor(g, '@compound', 0, {1, 0, 1})
print('one colour', list(select(2, sim.getShapeColor(g, '@compound', 0))))
sim.setShapeColor(g, '@compound', 0, {1, 0, 0, 0, 1, 0})
print('a colour each', list(select(2, sim.getShapeColor(g, '@compound', 0))))
print('too short', (pcall(sim.setShapeColor, g, '@compound', 0, {1, 0})))

local _, first = sim.createTexture('', 0, {1, 1}, {1, 1}, {0, 0, 0}, 0, {4, 4})
local _, second = sim.createTexture('', 0, {1, 1}, {1, 1}, {0, 0, 0}, 0, {4, 4})
print('two textures', first ~= second)
sim.writeTexture(first, 0, string.char(9):rep(48))
print('of one only', sim.readTexture(first, 0):byte(1), sim.readTexture(second, 0):byte(1) ~= 9)
print('no texture', pcall(sim.getTextureId, 'nothing'))

local path = sim.createPath({0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1}, 0, 10)
for i = 0, 2 do print('child', i, sim.getObjectAlias(sim.getObjectChild(path, i))) end

local master = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dependent, 0)
sim.setJointPosition(master, 0.3)
sim.setJointDependency(joint, master, 0.1, 2)
print('at once', sim.getJointPosition(joint))
sim.setJointMode(joint, sim.jointmode_kinematic, 0)
print('left', sim.getJointDependency(joint))
print('property', list(sim.getFloatArrayProperty(joint, 'dependencyParams')))

local collection = sim.createCollection(0)
sim.addItemToCollection(collection, sim.handle_single, joint, 0)
sim.addItemToCollection(collection, sim.handle_single, master, 0)
sim.addItemToCollection(collection, sim.handle_single, path, 0)
sim.addItemToCollection(collection, sim.handle_single, joint, 1)
sim.addItemToCollection(collection, sim.handle_single, joint, 0)
for _, member in ipairs(sim.getCollectionObjects(collection)) do print('member', member == master and 'master' or member == joint and 'joint' or 'path') end
