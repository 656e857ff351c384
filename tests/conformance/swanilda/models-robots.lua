-- topic: modules
-- as: customization
-- passes: 0
-- loops: 200
-- tol: 1e-4
-- spec: models 6; groups of joints, paths of robots, the ghost of a configuration
sim = require 'sim'

local function script(type, code, parent, alias)
    local handle = sim.createScript(type, code)
    if alias then sim.setObjectAlias(handle, alias) end
    sim.setObjectParent(handle, parent, false)
    return handle
end

function sysCall_init()
    robot = sim.createDummy(0.01)
    sim.setObjectAlias(robot, 'Robot')
    sim.setModelProperty(robot, 0)
    sim.setBoolProperty(robot, 'modelBase', true)
    joints = {}
    local parent = robot
    for i = 1, 2 do
        joints[i] = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
        sim.setObjectParent(joints[i], parent, false)
        local link = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.5}, 0)
        sim.setObjectParent(link, joints[i], false)
        parent = link
    end
    group = script(sim.scripttype_customization, "require 'models.jointGroup_customization'", robot, 'jointGroup')
    sim.setReferencedHandles(group, joints)
    sim.writeCustomStringData(group, '__jointGroup__', 'x')
    config = script(sim.scripttype_customization, "require 'models.robotConfig_customization-3'", robot, 'Config')
    sim.setReferencedHandles(config, {group}, 'jointGroup')
    path = require('models.robotConfigPath-3').create({{0, 0}, {0.5, 0.2}, {1, 0}}, robot, group)
    print(#require('addOns.jointGroup').getJointGroups(robot), sim.getObjectAlias(path, 1))
end

local passes = 0

local function call(name, handle, ...) return sim.callScriptFunction(name, handle, ...) end

function sysCall_nonSimulation()
    passes = passes + 1
    if passes == 2 then
        print(call('getConfig', group), call('isDynamicallyEnabled', group), #call('getPath', path))
        call('setConfig', group, {0.1, 0.2})
        print(call('getConfig', group), call('getTargetConfig', group))
        call('setConfig', config, {0.7, -0.7})
        print(call('hasModelClone', config), call('getConfig', config))
        call('createModelClone', config)
        print(call('hasModelClone', config), call('getConfig', config), #sim.getObjectsInTree(config) - 1)
        local shape = sim.getObjectsInTree(config, sim.sceneobject_shape)[1]
        local _, colour = sim.getShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse)
        print(colour, sim.getModelProperty(sim.getObjectChild(config, 0)) & sim.modelproperty_not_respondable ~= 0)
        call('reset', config)
        print(call('getConfig', config), call('getConfig', group))
        call('removeModelClone', config)
        print(call('hasModelClone', config), #sim.getObjectsInTree(config))
    elseif passes == 4 then
        call('setConfig', group, {0, 0})
        sim.startSimulation()
    end
end

local steps = 0

function sysCall_sensing()
    steps = steps + 1
    if steps == 1 then
        call('moveToConfig', group, {targetPos = {0.3, -0.3}, maxVel = 1, maxAccel = 10, maxJerk = 100})
    elseif steps == 4 then
        print(call('isMoveToConfigRunning', group), sim.getJointPosition(joints[1]) > 0)
    elseif steps == 30 then
        print(call('isMoveToConfigRunning', group), call('getConfig', group))
        follower = call('followPath', group, path, {fkMaxVel = 2, fkMaxAccel = {5, 5}})
    elseif steps == 100 then
        print(sim.isHandle(follower), call('getConfig', group))
        sim.quitSimulator()
    end
end
