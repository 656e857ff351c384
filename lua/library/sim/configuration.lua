--[[
Configurations: where the objects of a tree are, and how far their joints have moved (deprecated in CoppeliaSim).

A configuration is opaque to scripts. It belongs to the objects it was taken from: those that are gone are left out.
]]

local sim = ...
local M = {}

local SPHERICAL <const> = 'spherical'

local function jointState(object)
    if sim.getObjectType(object) ~= sim.object_joint_type then return nil end
    if sim.getJointType(object) == sim.joint_spherical_subtype then return sim.getQuaternionProperty(object, 'quaternion'), SPHERICAL end
    return sim.getJointPosition(object)
end

local function stateOf(object)
    local joint, kind = jointState(object)
    return {uid = sim.getLongProperty(object, 'objectUid'), pose = sim.getObjectPose(object, sim.handle_parent), joint = joint, kind = kind}
end

local function restore(object, state)
    sim.setObjectPose(object, state.pose, sim.handle_parent)
    if not state.joint then return end
    if state.kind == SPHERICAL then return sim.setQuaternionProperty(object, 'quaternion', state.joint) end
    sim.setJointPosition(object, state.joint)
end

local function configurationOf(objects)
    local states = {}
    for _, object in ipairs(objects) do states[#states + 1] = stateOf(object) end
    return sim.packTable(states)
end

local function apply(name, buffer)
    local read, states = pcall(sim.unpackTable, buffer)
    if not read or type(states) ~= 'table' then error(name .. ': the buffer holds no configuration.', 3) end
    for _, state in ipairs(states) do
        local found, object = pcall(sim.getObjectFromUid, state.uid, {noError = true})
        if found and object ~= -1 then restore(object, state) end
    end
end

--- The configuration of an object and of those below it.
-- @api buffer configuration = sim.getConfigurationTree(int objectHandle)
-- @param objectHandle its root
-- @return configuration for sim.setConfigurationTree
function M.getConfigurationTree(objectHandle) return configurationOf(sim.getObjectsInTree(objectHandle)) end

--- Restores the configuration of a tree: poses of the objects relative to their parents, positions of the joints.
-- @api sim.setConfigurationTree(buffer configuration)
-- @param configuration from sim.getConfigurationTree
function M.setConfigurationTree(configuration) apply('sim.setConfigurationTree', configuration) end

--- The configuration of one object.
-- @api buffer configuration = sim.getObjectConfiguration(int objectHandle)
-- @param objectHandle the object
-- @return configuration for sim.setObjectConfiguration
function M.getObjectConfiguration(objectHandle) return configurationOf({objectHandle}) end

--- Restores the configuration of one object.
-- @api sim.setObjectConfiguration(buffer configuration)
-- @param configuration from sim.getObjectConfiguration
function M.setObjectConfiguration(configuration) apply('sim.setObjectConfiguration', configuration) end

return M
