-- Makes robot.ttt and robot.ttm of this folder; make.sh runs it.
sim = require 'sim'
local folder = sim.getNamedStringParam('target')

local function under(parent, object, alias, position)
    sim.setObjectAlias(object, alias)
    sim.setObjectParent(object, parent, true)
    sim.setObjectPosition(object, position)
    return object
end

local base = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.1, 0.1, 0.3})
sim.setObjectAlias(base, 'robot')
sim.setModelProperty(base, 0)
sim.setShapeMass(base, 3)
sim.writeCustomStringData(base, 'info', 'a robot')
local joint = under(base, sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0), 'joint', {0, 0, 0.2})
sim.setJointInterval(joint, false, {-1, 2})
local boxes = {sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.05, 0.05}),
    sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.05, 0.05, 0.1})}
sim.setObjectPosition(boxes[2], {0.1, 0, 0.05})
local arm = under(joint, sim.groupShapes(boxes), 'arm', {0.1, 0, 0.25})
sim.setShapeColor(arm, nil, sim.colorcomponent_ambient_diffuse, {1, 0.5, 0})
under(arm, sim.createDummy(0.02), 'tip', {0.2, 0, 0.25})
local text = [[
function sysCall_init()
    sim = require 'sim'
end

function sysCall_actuation()
    sim.setJointTargetPosition(sim.getObject('../joint'), math.sin(sim.getSimulationTime()))
end
]]
under(base, sim.createScript(sim.scripttype_simulation, text), 'script', {0, 0, 0})
sim.saveModel(base, folder .. '/robot.ttm')
sim.setFloatParam(sim.floatparam_simulation_time_step, 0.02)
sim.saveScene(folder .. '/robot.ttt')
