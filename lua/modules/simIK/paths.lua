--[[
Postures along a line or a path object.
]]

local sim = require 'sim'
local configs = require 'simIK.configs'

local paths = {}

local INTS <const> = {type = 'table', item_type = 'int'}
local MAX_POINTS <const> = 100000

paths.LINE_ARGS = {
    {type = 'int'}, {type = 'int'}, INTS, {type = 'int'}, {type = 'int'}, {type = 'any', nullable = true},
    {type = 'any', nullable = true},
}
paths.PATH_ARGS = {
    {type = 'int'}, {type = 'int'}, {type = 'int'}, INTS, INTS, {type = 'int'}, {type = 'int'},
    {type = 'table', item_type = 'int', default = {}}, {type = 'table', default = {}},
}

local function solved(simIK, task)
    return simIK._handleGroups(task.env, {task.group}) == simIK.result_success
end

--- Flat list of postures from the tip to its target; empty if one of them fails. Works on a copy of the environment.
function paths.line(simIK, task, tip, count, callback, aux)
    local target = simIK.getTargetDummy(task.env, tip)
    if target == -1 then error('the tip has no target.', 3) end
    if count < 1 or count > MAX_POINTS then error('the number of points must be from 1 to 100000.', 3) end
    local accept = configs.callable(callback)
    local from, to = simIK.getObjectPose(task.env, tip), simIK.getObjectPose(task.env, target)
    local path = {}
    for i = 1, count do
        simIK.setObjectPose(task.env, target, sim.interpolatePoses(from, to, count > 1 and (i - 1) / (count - 1) or 1))
        if not solved(simIK, task) then return {} end
        local config = simIK.getConfig(task.env, task.joints)
        if accept and not accept(config, aux) then return {} end
        table.move(config, 1, #config, #path + 1, path)
    end
    return path
end

---------------------------------------------------------------- path objects

-- The poses of a path object in its frame, `delta` metres apart.
local function posesOf(simPath, delta)
    local data = sim.getBufferProperty(simPath, 'customData.PATH', {noError = true})
    if not data then error('object is no path.', 0) end
    local poses = sim.unpackDoubleTable(data)
    local positions = {}
    for i = 1, #poses, 7 do table.move(poses, i, i + 2, #positions + 1, positions) end
    local lengths, total = sim.getPathLengths(positions, 3)
    local count = math.max(2, math.min(MAX_POINTS, math.ceil(total / delta) + 1))
    local types = {0, 0, 0, 2, 2, 2, 2}
    return sim.resamplePath(poses, lengths, count, nil, types), count
end

local function collides(task, pairs, config)
    for i, joint in ipairs(task.simJoints) do sim.setJointPosition(joint, config[i]) end
    for i = 1, #pairs - 1, 2 do
        if sim.checkCollision(pairs[i], pairs[i + 1]) == 1 then return true end
    end
    return false
end

local function postures(simIK, task, simPath, pairs, delta)
    local poses, count = posesOf(simPath, delta)
    local list = {}
    for i = 1, count do
        simIK.setObjectPose(task.env, task.target, table.move(poses, 7 * i - 6, 7 * i, 1, {}), task.frame)
        if i == 1 then
            local start = configs.find(simIK, task, {maxTime = 0.5}, {})[1]
            if not start then error('the beginning of the path cannot be reached.', 0) end
            simIK.setConfig(task.env, task.joints, start)
        end
        if not solved(simIK, task) then error(('the path cannot be reached at point %d of %d.'):format(i, count), 0) end
        list[i] = simIK.getConfig(task.env, task.joints)
        if #pairs > 0 and collides(task, pairs, list[i]) then
            error(('there is a collision at point %d of %d.'):format(i, count), 0)
        end
    end
    return list
end

--- A list of postures; nil if `opts.errorCallback` has been called. The joints of the scene are where they were.
function paths.follow(simIK, task, simPath, pairs, opts)
    local delta = tonumber(opts.delta) or 0.005
    if not (delta > 0) then error("'delta' must be positive.", 3) end
    local before = {}
    for i, joint in ipairs(task.simJoints) do before[i] = sim.getJointPosition(joint) end
    local ok, result = pcall(postures, simIK, task, simPath, pairs, delta)
    for i, joint in ipairs(task.simJoints) do sim.setJointPosition(joint, before[i]) end
    if ok then return result end
    local report = configs.callable(opts.errorCallback)
    if not report then error(result, 3) end
    report(result)
end

return paths
