--[[
Script that keeps a configuration of a robot and shows it by a ghost, a copy of the robot that does nothing: `require 'models.robotConfig_customization-3'` in a script of the robot
(spec: models 6). The joints are those of its referenced handle `jointGroup`.

Globals of the script: model (':', the model it is in), color ({1, 0, 0}), transparency (0.5), ik (true: the ghost keeps the parts for inverse kinematics).
Functions: hasModelClone, createModelClone, removeModelClone, getConfig, setConfig, saveConfig, restoreConfig, saveIkTarget, restoreIkTarget, reset.
]]

local sim = _quietRequire 'sim'

local GHOST <const>, CONFIG <const>, TARGET <const> = 'customData.robotConfigGhost', 'config', 'ikTargetPose'
local BARE <const> = 2 | 4 | 8 -- copies without scripts, custom data and referenced handles
local PASSIVE <const> = {
    'modelproperty_not_collidable', 'modelproperty_not_measurable', 'modelproperty_not_detectable', 'modelproperty_not_dynamic',
    'modelproperty_not_respondable',
}

local function self() return sim.getObject('.') end

local function robot() return sim.getObject(model or ':') end

local function ghost()
    local i = 0
    while true do
        local child = sim.getObjectChild(self(), i)
        if child == -1 then return nil end
        if sim.getBoolProperty(child, GHOST, {noError = true}) then return child end
        i = i + 1
    end
end

local function originals()
    local group = sim.getReferencedHandles(self(), 'jointGroup')[1]
    if not group or not sim.isHandle(group) then error('the referenced handle jointGroup is missing', 0) end
    return sim.getReferencedHandles(group)
end

function hasModelClone() return ghost() ~= nil end

---------------------------------------------------------------- the ghost

local function named(name) return name == 'MotionPlanning' or name == 'Path' or name == 'IK' and ik == false end

-- Objects of a tree without scripts, and without some parts by their names.
local function copied(base)
    local gone, list = {}, {}
    for _, object in ipairs(sim.getObjectsInTree(base)) do
        local isScript = sim.getObjectType(object) == sim.sceneobject_script
        if object ~= base and (isScript or named(sim.getObjectAlias(object)) or gone[sim.getObjectParent(object)]) then
            gone[object] = true
        else
            list[#list + 1] = object
        end
    end
    return list
end

local function paint(clone)
    for _, shape in ipairs(sim.getObjectsInTree(clone, sim.sceneobject_shape)) do
        sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, color or {1, 0, 0})
        sim.setShapeColor(shape, nil, sim.colorcomponent_transparency, {transparency or 0.5})
    end
end

local function disarm(clone)
    local property = sim.getModelProperty(clone)
    for _, name in ipairs(PASSIVE) do property = property | sim[name] end
    sim.setModelProperty(clone, property)
end

--- Makes the ghost, with the configuration that was saved.
function createModelClone()
    if ghost() then return end
    local objects, joints = copied(robot()), {}
    local copies = sim.copyPasteObjects(objects, BARE)
    local clone = copies[1]
    for i, object in ipairs(objects) do
        for k, joint in ipairs(originals()) do
            if joint == object then joints[k] = copies[i] end
        end
    end
    sim.setReferencedHandles(clone, joints, 'ghostJoints')
    sim.setBoolProperty(clone, GHOST, true)
    disarm(clone)
    paint(clone)
    sim.setObjectParent(clone, self(), true)
    restoreConfig()
end

--- Removes the ghost.
-- @param delayedRemoval when the scripts have run
function removeModelClone(delayedRemoval)
    local clone = ghost()
    if clone then sim.removeModel(clone, delayedRemoval or false) end
end

---------------------------------------------------------------- configurations

local function shown()
    local clone = ghost()
    return clone and sim.getReferencedHandles(clone, 'ghostJoints')
end

local function positions(joints)
    local values = {}
    for i, joint in ipairs(joints) do values[i] = sim.getJointPosition(joint) end
    return values
end

--- The configuration of the ghost, else the one that was saved, else that of the robot.
function getConfig()
    local joints = shown()
    if joints then return positions(joints) end
    local saved = sim.readCustomTableData(self(), CONFIG)
    return #saved > 0 and saved or positions(originals())
end

--- Changes what is saved, and what the ghost shows.
function setConfig(config)
    for i, joint in ipairs(shown() or {}) do sim.setJointPosition(joint, config[i]) end
    sim.writeCustomTableData(self(), CONFIG, config)
end

function saveConfig() sim.writeCustomTableData(self(), CONFIG, getConfig()) end

function restoreConfig()
    local saved = sim.readCustomTableData(self(), CONFIG)
    for i, joint in ipairs(#saved > 0 and shown() or {}) do sim.setJointPosition(joint, saved[i]) end
end

--- Back to where the robot is.
function reset() setConfig(positions(originals())) end

local function target()
    local clone = ghost()
    local object = clone and sim.getObject('./target', {proxy = clone, noError = true})
    if not object or object == -1 then error('the ghost has no dummy with the alias target', 0) end
    return object, clone
end

--- Remembers the pose of the ghost's dummy `target`, in the ghost's frame.
function saveIkTarget() sim.writeCustomTableData(self(), TARGET, sim.getObjectPose(target())) end

--- Moves the ghost's dummy `target` to where it was, or to a pose.
function restoreIkTarget(pose)
    pose = pose or sim.readCustomTableData(self(), TARGET)
    local object, clone = target()
    if #pose == 7 then sim.setObjectPose(object, pose, clone) end
end

---------------------------------------------------------------- callbacks

function sysCall_init() end

function sysCall_cleanup() end

--- Shows the ghost, or hides it.
function sysCall_userConfig()
    if ghost() then
        saveConfig()
        removeModelClone()
    else
        createModelClone()
    end
end
