--[[
Forward and inverse kinematics. Mechanisms are modelled in environments of their own, by hand or as copies of chains of the scene.

The solver and all that deals with objects is native; here are options, postures that a callback accepts, paths and overlays.
]]

local _, simIK = ...

local sim = require 'sim'
local check = require 'checkargs.check'
local callbacks = require 'simIK.callbacks'
local configs = require 'simIK.configs'
local overlays = require 'simIK.overlays'
local paths = require 'simIK.paths'

local eraseEnvironment = simIK.eraseEnvironment

--- Removes an environment, and overlays of it.
-- @api simIK.eraseEnvironment(int environmentHandle)
-- @param environmentHandle the environment
function simIK.eraseEnvironment(environmentHandle)
    eraseEnvironment(environmentHandle)
    overlays.forget(environmentHandle)
end

simIK._eraseEnvironment = eraseEnvironment

---------------------------------------------------------------- calculations

local HANDLE_ARGS = {{type = 'int'}, {type = 'table', item_type = 'int'}, {type = 'table', default = {}}}
local HANDLE_ONE_ARGS = {{type = 'int'}, {type = 'int'}, {type = 'table', default = {}}}

local function handle(env, groups, options)
    if options.syncWorlds then simIK.syncFromSim(env, groups) end
    local callback = options.callback and callbacks.of(options.callback, options.auxData)
    local result, flags, precision = simIK._handleGroups(env, groups, callback)
    for _, group in ipairs(groups) do simIK.debugGroupIfNeeded(env, group, options.debug) end
    local missed = flags & simIK.calc_notwithintolerance ~= 0
    if options.syncWorlds and (options.allowError or not missed) then simIK.syncToSim(env, groups) end
    return result, flags, precision
end

--- Moves the joints of groups towards a solution.
-- @api int success, int flags, float[2] precision = simIK.handleGroups(int environmentHandle, int[] ikGroups, map options = {})
-- @param environmentHandle the environment
-- @param ikGroups the groups, by falling priority; the number of iterations is that of the first
-- @param options syncWorlds: joints and targets come from the scene, and joints go back to it; allowError: also where the precision is missed; callback(data, auxData), called in each iteration of each group with the matrices jacobian and e, rows, cols, groupIndex and iteration, may return a table with jacobian, e, dq or jacobianPinv; auxData; debug: 1 for an overlay
-- @return success simIK.result_*
-- @return flags simIK.calc_*
-- @return precision largest linear (m) and angular (rad) error
function simIK.handleGroups(...)
    local env, groups, options = check(HANDLE_ARGS, ...)
    return handle(env, groups, options)
end

--- Moves the joints of a group towards a solution.
-- @api int success, int flags, float[2] precision = simIK.handleGroup(int environmentHandle, int ikGroup, map options = {})
-- @param environmentHandle the environment
-- @param ikGroup the group
-- @param options as in simIK.handleGroups
-- @return success simIK.result_*
-- @return flags simIK.calc_*
-- @return precision largest linear (m) and angular (rad) error
function simIK.handleGroup(...)
    local env, group, options = check(HANDLE_ONE_ARGS, ...)
    return handle(env, {group}, options)
end

local REASONS = {
    {'calc_notperformed', 'nothing was calculated: the group or its elements are disabled, without a joint or without a target'},
    {'calc_cannotinvert', 'the Jacobian could not be inverted'},
    {'calc_notwithintolerance', 'the precision was not reached'},
    {'calc_stepstoobig', 'steps of joints were larger than allowed'},
    {'calc_limithit', 'a joint was stopped at its limit'},
    {'calc_invalidcallbackdata', 'the callback returned numbers that are not finite'},
}

--- What flags of a calculation mean.
-- @api string description = simIK.getFailureDescription(int reason)
-- @param reason simIK.calc_*
-- @return description empty for none
function simIK.getFailureDescription(reason)
    local texts = {}
    for _, entry in ipairs(REASONS) do
        if reason & simIK[entry[1]] ~= 0 then texts[#texts + 1] = entry[2] end
    end
    return table.concat(texts, '; ')
end

---------------------------------------------------------------- postures

--- Positions of joints.
-- @api float[] config = simIK.getConfig(int environmentHandle, int[] jointHandles)
-- @param environmentHandle the environment
-- @param jointHandles the joints
-- @return config rad, m
function simIK.getConfig(environmentHandle, jointHandles)
    local config = {}
    for i, joint in ipairs(jointHandles) do config[i] = simIK.getJointPosition(environmentHandle, joint) end
    return config
end

--- Moves joints.
-- @api simIK.setConfig(int environmentHandle, int[] jointHandles, float[] config)
-- @param environmentHandle the environment
-- @param jointHandles the joints
-- @param config rad, m
function simIK.setConfig(environmentHandle, jointHandles, config)
    for i, joint in ipairs(jointHandles) do simIK.setJointPosition(environmentHandle, joint, config[i]) end
end

--- Postures that satisfy a group, the closest to the present one first. The joints stay where they are.
-- @api any[] configs = simIK.findConfigs(int envHandle, int ikGroupHandle, int[] jointHandles, map params = {}, any[] configs = {})
-- @param envHandle the environment
-- @param ikGroupHandle the group
-- @param jointHandles joints whose positions are wanted
-- @param params findMultiple; findAlt (true): with full turns of joints; maxTime (0.2 s, counted as 100000 iterations per second); cMetric: factors of joints for distances; cb(config, auxData) accepts a posture; auxData
-- @param configs other postures, which are sorted in
-- @return configs a list for each posture; empty if there are none
function simIK.findConfigs(...)
    local env, group, joints, params, others = check(configs.ARGS, ...)
    return configs.find(simIK, {env = env, group = group, joints = joints}, params, others)
end

--- A posture that satisfies a group. The joints stay where they are.
-- @api float[] jointPositions = simIK.findConfig(int environmentHandle, int ikGroup, int[] joints, float thresholdDist = 0.1, float maxTime = 0.5, float[4] metric = {1, 1, 1, 0.1}, any callback = nil, any auxData = nil)
-- @param environmentHandle the environment
-- @param ikGroup the group
-- @param joints joints whose positions are wanted
-- @param thresholdDist not used: starts are not limited
-- @param maxTime seconds, counted as 100000 iterations each
-- @param metric not used
-- @param callback accepts a posture
-- @param auxData for the callback
-- @return jointPositions nil if none was found
function simIK.findConfig(...)
    local env, group, joints, _, maxTime, _, callback, aux = check(configs.OLD_ARGS, ...)
    local params = {maxTime = maxTime, cb = callback, auxData = aux, findAlt = false}
    return configs.find(simIK, {env = env, group = group, joints = joints}, params, {})[1]
end

--- As simIK.findConfig, within other limits.
-- @api float[] jointPositions = simIK.getConfigForTipPose(int environmentHandle, int ikGroup, int[] joints, float thresholdDist = 0.1, float maxTime = 0.5, float[4] metric = {1, 1, 1, 0.1}, any callback = nil, any auxData = nil, int[] jointOptions = {}, float[] lowLimits = {}, float[] ranges = {})
-- @param environmentHandle the environment
-- @param ikGroup the group
-- @param joints joints whose positions are wanted
-- @param thresholdDist not used: starts are not limited
-- @param maxTime seconds, counted as 100000 iterations each
-- @param metric not used
-- @param callback accepts a posture
-- @param auxData for the callback
-- @param jointOptions not used
-- @param lowLimits of the joints
-- @param ranges of the joints
-- @return jointPositions nil if none was found
function simIK.getConfigForTipPose(...)
    local env, group, joints, _, maxTime, _, callback, aux, _, lowLimits, ranges = check(configs.LIMITED_ARGS, ...)
    local params = {maxTime = maxTime, cb = callback, auxData = aux, findAlt = false}
    local copy <close> = configs.copy(simIK, env)
    for i, joint in ipairs(joints) do
        if lowLimits[i] and ranges[i] then
            simIK.setJointInterval(copy.env, joint, false, {lowLimits[i], ranges[i]})
        end
    end
    return configs.find(simIK, {env = copy.env, group = group, joints = joints}, params, {})[1]
end

--- The present posture, and those with full turns added where joints allow them.
-- @api float[] configs = simIK.getAlternateConfigs(int environmentHandle, int[] jointHandles, float[] lowLimits = nil, float[] ranges = nil)
-- @param environmentHandle the environment
-- @param jointHandles the joints
-- @param lowLimits instead of those of the joints
-- @param ranges instead of those of the joints
-- @return configs flat list
function simIK.getAlternateConfigs(...)
    local env, joints, lowLimits, ranges = check(configs.ALTERNATE_ARGS, ...)
    local all = configs.alternatives(simIK, env, joints, simIK.getConfig(env, joints), lowLimits, ranges)
    local flat = {}
    for _, config in ipairs(all) do table.move(config, 1, #config, #flat + 1, flat) end
    return flat
end

---------------------------------------------------------------- paths

--- Postures on the straight line from a tip to its target. The joints stay where they are.
-- @api float[] path = simIK.generatePath(int environmentHandle, int ikGroupHandle, int[] jointHandles, int tipHandle, int pathPointCount, func validationCallback = nil, any auxData = nil)
-- @param environmentHandle the environment
-- @param ikGroupHandle the group
-- @param jointHandles joints whose positions are wanted
-- @param tipHandle the tip
-- @param pathPointCount how many postures, both ends among them
-- @param validationCallback accepts a posture
-- @param auxData for the callback
-- @return path flat list; empty if a posture could not be found or was not accepted
function simIK.generatePath(...)
    local env, group, joints, tip, count, callback, aux = check(paths.LINE_ARGS, ...)
    local copy <close> = configs.copy(simIK, env)
    return paths.line(simIK, {env = copy.env, group = group, joints = joints}, tip, count, callback, aux)
end

--- Postures with which a target follows a path object.
-- @api float[] configs = simIK.solvePath(int environmentHandle, int ikGroup, int ikTarget, int[] ikJoints, int[] simJoints, int ikPath, int simPath, int[] collisionPairs = {}, map opts = {})
-- @param environmentHandle the environment
-- @param ikGroup the group
-- @param ikTarget its target
-- @param ikJoints joints whose positions are wanted
-- @param simJoints the same joints in the scene
-- @param ikPath the frame of the path in the environment
-- @param simPath the path object
-- @param collisionPairs entities of the scene, two by two, that must not collide
-- @param opts delta (0.005 m) between postures; errorCallback(text), called instead of raising an error
-- @return configs a list for each posture; nil if there is no way
function simIK.solvePath(...)
    local env, group, target, ikJoints, simJoints, ikPath, simPath, pairs, opts = check(paths.PATH_ARGS, ...)
    local copy <close> = configs.copy(simIK, env)
    local task = {env = copy.env, group = group, joints = ikJoints, simJoints = simJoints, target = target, frame = ikPath}
    return paths.follow(simIK, task, simPath, pairs, opts)
end

---------------------------------------------------------------- overlays

--- Shows a chain in the scene, with drawing objects: lines between joints, and their axes.
-- @api int debugObject = simIK.createDebugOverlay(int environmentHandle, int tipHandle, int baseHandle = -1)
-- @param environmentHandle the environment
-- @param tipHandle the tip
-- @param baseHandle where the chain begins, -1 for the world
-- @return debugObject for simIK.eraseDebugOverlay
function simIK.createDebugOverlay(environmentHandle, tipHandle, baseHandle)
    return overlays.create(simIK, environmentHandle, tipHandle, baseHandle or -1)
end

--- Removes an overlay.
-- @api simIK.eraseDebugOverlay(int debugObject)
-- @param debugObject from simIK.createDebugOverlay
function simIK.eraseDebugOverlay(debugObject) overlays.erase(debugObject) end

--- Shows the chains of a group, if flags say so.
-- @api simIK.debugGroupIfNeeded(int environmentHandle, int ikGroup, int debugFlags)
-- @param environmentHandle the environment
-- @param ikGroup the group
-- @param debugFlags bit 0: an overlay; bit 1: the Jacobian in the log
function simIK.debugGroupIfNeeded(environmentHandle, ikGroup, debugFlags)
    local flags = math.tointeger(debugFlags) or 0
    if flags & 1 ~= 0 then overlays.ofGroup(simIK, environmentHandle, ikGroup) end
    if flags & 2 ~= 0 then
        local jacobian, errors = simIK.computeGroupJacobian(environmentHandle, ikGroup)
        simIK.debugJacobianDisplay{jacobian = jacobian, e = errors, groupIndex = ikGroup}
    end
end

--- Logs a Jacobian, row by row with the errors: there is no window for it.
-- @api simIK.debugJacobianDisplay(map inData)
-- @param inData jacobian and e
function simIK.debugJacobianDisplay(inData) sim.addLog(sim.verbosity_scriptinfos, overlays.text(inData)) end

---------------------------------------------------------------- older names

--- As simIK.addElementFromScene.
-- @api int ikElement, map simToIkMap, map ikToSimMap = simIK.addIkElementFromScene(int environmentHandle, int ikGroup, int baseHandle, int tipHandle, int targetHandle, int constraints)
-- @param environmentHandle the environment
-- @param ikGroup the group
-- @param baseHandle where the chain begins, -1 for the world
-- @param tipHandle the tip
-- @param targetHandle the target
-- @param constraints simIK.constraint_*
-- @return ikElement the element
-- @return simToIkMap copies by the handles of the scene's objects
-- @return ikToSimMap the scene's objects by the handles of their copies
function simIK.addIkElementFromScene(environmentHandle, ikGroup, baseHandle, tipHandle, targetHandle, constraints)
    return simIK.addElementFromScene(environmentHandle, ikGroup, baseHandle, tipHandle, targetHandle, constraints)
end

--- As simIK.handleGroup.
-- @api int success, int flags, float[2] precision = simIK.handleIkGroup(int environmentHandle, int ikGroup, map options = {})
-- @param environmentHandle the environment
-- @param ikGroup the group
-- @param options as in simIK.handleGroups
-- @return success simIK.result_*
-- @return flags simIK.calc_*
-- @return precision largest linear (m) and angular (rad) error
function simIK.handleIkGroup(...) return simIK.handleGroup(...) end

--- As simIK.syncFromSim, for one group.
-- @api simIK.applySceneToIkEnvironment(int environmentHandle, int ikGroup)
-- @param environmentHandle the environment
-- @param ikGroup a group with elements from the scene
function simIK.applySceneToIkEnvironment(environmentHandle, ikGroup) simIK.syncFromSim(environmentHandle, {ikGroup}) end

--- Calculates a group with targets and joints of the scene, and moves the joints of the scene.
-- @api int result, int reason = simIK.applyIkEnvironmentToScene(int environmentHandle, int ikGroup, bool applyOnlyWhenSuccessful = false)
-- @param environmentHandle the environment
-- @param ikGroup a group with elements from the scene
-- @param applyOnlyWhenSuccessful whether the joints of the scene stay where the precision is missed
-- @return result simIK.result_*
-- @return reason simIK.calc_*
function simIK.applyIkEnvironmentToScene(environmentHandle, ikGroup, applyOnlyWhenSuccessful)
    local options = {syncWorlds = true, allowError = not applyOnlyWhenSuccessful}
    local result, reason = simIK.handleGroup(environmentHandle, ikGroup, options)
    return result, reason
end

return simIK
