-- topic: joints
-- as: sandbox
-- passes: 0
-- spec: joints 3, joints 7, poses 1, shapes 2.1, shapes 2.2, shapes 4, shapes 6, shapes 7
-- tol: 1e-6
-- note: joints and shapes in old functions, by closed forms
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
local text = require('lib.trial').text

local function close(list, wanted)
    for i, x in ipairs(wanted) do if math.abs(x - list[i]) > 1e-6 then return text(list) end end
    return #list == #wanted
end

-- The moving side of joints: a turn about z with the way of a screw, a way along z, any rotation.
local screw = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
sim.setJointInterval(screw, false, {-3, 6})
sim.setObjectFloatParam(screw, sim.jointfloatparam_screwlead, 2 * math.pi)
sim.setJointPosition(screw, 0.5)
sim.setObjectPose(screw, {7, 8, 9, 1, 0, 0, 0})
local c, s = math.cos(0.5), math.sin(0.5)
print('revolute', close(sim.getJointMatrix(screw), {c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0.5}))
local slider = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
sim.setJointPosition(slider, 0.25)
print('prismatic', close(sim.getJointMatrix(slider), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.25}))
local ball = sim.createJoint(sim.joint_spherical, sim.jointmode_kinematic, 0)
local tip = sim.createDummy(0.01)
sim.setObjectParent(tip, ball, true)
sim.setObjectPosition(tip, {0, 0, 1})
-- A quarter turn about x takes z to -y. The translation does not count.
local quarter = {1, 0, 0, 5, 0, 0, -1, 5, 0, 1, 0, 5}
sim.setSphericalJointMatrix(ball, quarter)
print('spherical', close(sim.getJointMatrix(ball), {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0}), close(sim.getObjectPosition(tip), {0, -1, 0}))
print('not spherical', (pcall(sim.setSphericalJointMatrix, slider, quarter)), (pcall(sim.getJointMatrix, tip)))

-- The largest force has no sign of its own: it gets that of the target velocity.
local motor = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
sim.setObjectInt32Param(motor, sim.jointintparam_dynctrlmode, sim.jointdynctrl_velocity)
sim.setJointTargetVelocity(motor, 2)
sim.setJointMaxForce(motor, 7)
print('force', sim.getJointMaxForce(motor), sim.getJointTargetForce(motor), sim.getJointTargetVelocity(motor))
sim.setJointForce(motor, 3)
print('force', sim.getJointMaxForce(motor), sim.getJointTargetForce(motor))
sim.setJointTargetVelocity(motor, -2)
sim.setJointForce(motor, 4)
print('force', sim.getJointTargetForce(motor), sim.getJointTargetVelocity(motor))
sim.setJointMaxForce(motor, -4)
print('negative', math.abs(sim.getJointTargetForce(motor)))

-- A block of 12 kg and 1 x 2 x 3 m: 13, 10 and 5 kg m2, in the world; turned about z the first two change places.
local block = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 2, 3})
sim.setShapeMass(block, 12)
sim.setObjectPosition(block, {1, 2, 3})
local mass, inertia, centre = sim.getShapeMassAndInertia(block)
print('block', mass, close(inertia, {13, 0, 0, 0, 10, 0, 0, 0, 5}), close(centre, {1, 2, 3}))
sim.setObjectPose(block, {1, 2, 3, 0, 0, math.sqrt(0.5), math.sqrt(0.5)})
mass, inertia, centre = sim.getShapeMassAndInertia(block)
print('turned', mass, close(inertia, {10, 0, 0, 0, 13, 0, 0, 0, 5}), close(centre, {1, 2, 3}))
mass, inertia, centre = sim.getShapeMassAndInertia(block, sim.getObjectMatrix(block))
print('own frame', mass, close(inertia, {13, 0, 0, 0, 10, 0, 0, 0, 5}), close(centre, {0, 0, 0}))
sim.setShapeMassAndInertia(block, 2, {1, 0, 0, 0, 2, 0, 0, 0, 2.5}, {1.5, 2, 3})
inertia = sim.getShapeInertia(block)
local _, own = sim.getShapeInertia(block)
-- In its own frame, a quarter turn back: x of the world is -y of the block.
print('set', sim.getShapeMass(block), close(inertia, {2, 0, 0, 0, 1, 0, 0, 0, 2.5}), close({own[4], own[8], own[12]}, {0, -0.5, 0}))
sim.setShapeMassAndInertia(block, 4, {3, 0, 0, 0, 4, 0, 0, 0, 5}, {0, 0, 0.25}, sim.getObjectMatrix(block))
inertia, own = sim.getShapeInertia(block)
print('set', sim.getShapeMass(block), close(inertia, {3, 0, 0, 0, 4, 0, 0, 0, 5}), close({own[4], own[8], own[12]}, {0, 0, 0.25}))

-- Corners of a cube on its edge: along the world's axes its box is wider by the root of 2. A primitive keeps its box.
local corners, r = {}, math.sqrt(0.5)
for _, z in ipairs{-0.5, 0.5} do for _, p in ipairs{{r, 0}, {0, r}, {-r, 0}, {0, -r}} do table.move({p[1], p[2], z}, 1, 3, #corners + 1, corners) end end
local faces = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7}
local cube = sim.createMeshShape(0, 0, corners, faces)
local vertices, indices = sim.getShapeMesh(cube)
print('mesh', #vertices, #indices, (sim.getShapeGeomInfo(cube)), close(sim.getShapeBB(cube), {1, 1, 1}))
print('box', sim.reorientShapeBoundingBox(cube, -1), close(sim.getShapeBB(cube), {2 * r, 2 * r, 1}))
local frame = sim.createDummy(0.01)
sim.setObjectOrientation(frame, {0, 0, math.pi / 4})
print('box', sim.reorientShapeBoundingBox(cube, frame), close(sim.getShapeBB(cube), {1, 1, 1}))
print('primitive', sim.reorientShapeBoundingBox(block, frame), close(sim.getShapeBB(block), {1, 2, 3}))

-- Pure shapes: options 8 respondable, 16 static, 32 with open ends, which is not pure.
for kind = 0, 3 do
    for _, options in ipairs{0, 8, 16, 32} do
        local shape = sim.createPureShape(kind, options, {0.2, 0.2, 0.4}, 2)
        local info, primitive, sizes = sim.getShapeGeomInfo(shape)
        print('pure', kind, options, sim.getShapeMass(shape), sim.getObjectInt32Param(shape, sim.shapeintparam_respondable), sim.getObjectInt32Param(shape, sim.shapeintparam_static), info, primitive, text(sizes))
    end
end
