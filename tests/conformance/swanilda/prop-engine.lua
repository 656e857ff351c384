-- topic: properties
-- as: sandbox
-- passes: 0
-- spec: properties 6, dynamics 5, dynamics 6
-- note: parameters of physics engines by their property, by their old number and as JSON are one value
sim = require 'sim'
local scene = sim.handle_scene
local function refused(f, ...) local ok, message = pcall(f, ...) print(ok, (tostring(message):gsub('^%-?%d+: ', ''))) end

local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
print(sim.getFloatProperty(shape, 'bullet.frictionOld'), sim.getEngineFloatParam(sim.bullet_body_oldfriction, shape))
sim.setFloatProperty(shape, 'bullet.frictionOld', 0.25)
print(sim.getEngineFloatParam(sim.bullet_body_oldfriction, shape))
sim.setEngineFloatParam(sim.mujoco_body_solref2, shape, 0.5)
print(sim.getFloatArrayProperty(shape, 'mujoco.solref'))
sim.setEngineInt32Param(sim.vortex_body_bitcoded, shape, 8)
print(sim.getBoolProperty(shape, 'vortex.fastMoving'), sim.getBoolProperty(shape, 'vortex.linearSecondaryAxisFollowPrimaryAxis'))
local copy = sim.copyPasteObjects({shape}, 0)[1]
print(sim.getFloatArrayProperty(copy, 'mujoco.solref'), sim.getFloatProperty(copy, 'bullet.frictionOld'))
sim.setShapeMaterial(copy, sim.dynmat_lowfriction)
print(sim.getFloatProperty(copy, 'bullet.friction'), sim.getFloatProperty(copy, 'ode.friction'), sim.getFloatArrayProperty(copy, 'mujoco.solref'))

local joint = sim.createJoint(sim.joint_revolute_subtype, sim.jointmode_dynamic, 0)
sim.setFloatArrayProperty(joint, 'ode.posPid', {0.4, 0.3, 0.2})
print(sim.getEngineFloatParam(sim.ode_joint_pospid2, joint), sim.getFloatArrayProperty(joint, 'bullet.posPid'))
refused(sim.setFloatArrayProperty, joint, 'ode.posPid', {0.4})
refused(sim.setFloatProperty, joint, 'ode.fudge', math.huge)
refused(sim.getEngineFloatParam, sim.bullet_body_oldfriction, joint)
refused(sim.getEngineFloatParam, 123456, joint)

sim.setEngineBoolParam(sim.bullet_global_fullinternalscaling, -1, false)
print(sim.getEngineInt32Param(sim.bullet_global_bitcoded, -1), sim.getBoolProperty(scene, 'bullet.internalScalingFull'))
sim.setStringProperty(scene, 'engineProperties', '{"bullet": {"iterations": 7, "later": 1}, "mujoco": {"wind": [1, 2, 3]}}')
print(sim.getEngineInt32Param(sim.bullet_global_constraintsolvingiterations, -1), sim.getVector3Property(scene, 'mujoco.wind'))
refused(sim.setStringProperty, scene, 'engineProperties', '{"bullet": {"iterations": 8, "solver": "fast"}}')
refused(sim.setStringProperty, scene, 'engineProperties', '{"bullet": ')
print(sim.getIntProperty(scene, 'bullet.iterations'))
sim.setInt32Param(sim.intparam_dynamic_engine, sim.physics_newton)
print(sim.getStringProperty(scene, 'engineProperties'))
