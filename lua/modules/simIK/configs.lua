--[[
Postures that satisfy a group: searched natively in portions, accepted by a callback, sorted by their distance from the present posture.

Time limits count iterations, so that runs repeat on slow and busy machines too; the clock only ends a search whose callback takes much longer
than was allowed.
]]

local sim = require 'sim'

local configs = {}

local ITERATIONS_PER_SECOND <const> = 100000
local PORTION <const> = 2000
-- How many times as long as allowed a search with a callback may take by the clock.
local CLOCK_FACTOR <const> = 10
local MAX_ALTERNATIVES <const> = 1000
-- Postures whose distances from the present one differ less, and whose joints differ less, are the same.
local TOLERANCE <const> = 1e-3

local INTS <const> = {type = 'table', item_type = 'int'}
local FLOATS <const> = {type = 'table', item_type = 'float', nullable = true}

configs.ARGS = {{type = 'int'}, {type = 'int'}, INTS, {type = 'table', default = {}}, {type = 'table', default = {}}}
configs.ALTERNATE_ARGS = {{type = 'int'}, INTS, FLOATS, FLOATS}
configs.OLD_ARGS = {
    {type = 'int'}, {type = 'int'}, INTS, {type = 'float', default = 0.1}, {type = 'float', default = 0.5}, FLOATS,
    {type = 'any', nullable = true}, {type = 'any', nullable = true},
}
configs.LIMITED_ARGS = table.move(configs.OLD_ARGS, 1, 8, 1, {})
for i = 9, 11 do configs.LIMITED_ARGS[i] = {type = 'table', item_type = i == 9 and 'int' or 'float', default = {}} end

--- A copy of an environment that ends with its variable.
function configs.copy(simIK, env)
    local copy = {env = simIK.duplicateEnvironment(env)}
    return setmetatable(copy, {__close = function() simIK.eraseEnvironment(copy.env) end})
end

--- A function from a function or the name of a global one.
function configs.callable(callback)
    if callback == nil or type(callback) == 'function' then return callback end
    local found = _G[tostring(callback):match('^[^@]*')]
    if type(found) ~= 'function' then error('the callback is no function.', 3) end
    return found
end

---------------------------------------------------------------- full turns

local function turns(simIK, env, joint, position, low, range)
    local cyclic, interval = simIK.getJointInterval(env, joint)
    low, range = low or interval[1], range or interval[2]
    if cyclic or simIK.getJointType(env, joint) ~= simIK.jointtype_revolute or range <= 2 * math.pi then
        return {position}
    end
    local values = {}
    local value = position - math.floor((position - low) / (2 * math.pi)) * 2 * math.pi
    while value <= low + range and #values < MAX_ALTERNATIVES do
        values[#values + 1] = value
        value = value + 2 * math.pi
    end
    return #values > 0 and values or {position}
end

--- All combinations of full turns of the joints of one posture.
function configs.alternatives(simIK, env, joints, config, lowLimits, ranges)
    local all = {{}}
    for i, joint in ipairs(joints) do
        local values = turns(simIK, env, joint, config[i], lowLimits and lowLimits[i], ranges and ranges[i])
        local longer = {}
        for _, part in ipairs(all) do
            for _, value in ipairs(values) do
                if #longer == MAX_ALTERNATIVES then break end
                local one = table.move(part, 1, i - 1, 1, {})
                one[i] = value
                longer[#longer + 1] = one
            end
        end
        all = longer
    end
    return all
end

---------------------------------------------------------------- search

-- Calls `found` with each posture until it returns true, or the time is over; by the clock too if it is `slow`.
local function search(simIK, task, maxTime, slow, found)
    local left = math.max(1, math.min(maxTime * ITERATIONS_PER_SECOND, 1 << 31) // 1 | 0)
    local ending = slow and sim.getSystemTime() + CLOCK_FACTOR * maxTime or math.huge
    local fromPresent = true
    while left > 0 do
        local portion = math.min(left, PORTION)
        local rest, config = simIK._findConfig(task.env, task.group, task.joints, portion, fromPresent)
        if config and found(config) or not config and rest == portion then return end
        left, fromPresent = left - portion + rest, false
        if slow and sim.getSystemTime() > ending then return end
    end
end

local function distances(simIK, task, metric)
    local present, cyclic = simIK.getConfig(task.env, task.joints), {}
    for i, joint in ipairs(task.joints) do
        cyclic[i] = simIK.getJointInterval(task.env, joint) and simIK.getJointType(task.env, joint) == simIK.jointtype_revolute
    end
    return function(config)
        local sum = 0.0
        for i, position in ipairs(config) do
            local difference = position - present[i]
            if cyclic[i] then difference = math.atan(math.sin(difference), math.cos(difference)) end
            sum = sum + (difference * (metric and metric[i] or 1)) ^ 2
        end
        return math.sqrt(sum)
    end
end

local function isSame(a, b)
    for i, position in ipairs(a) do
        if math.abs(position - b[i]) > TOLERANCE then return false end
    end
    return true
end

-- By distance; of postures that are the same, one is left.
local function sorted(all, distanceOf)
    local entries = {}
    for i, config in ipairs(all) do entries[i] = {config = config, distance = distanceOf(config), number = i} end
    table.sort(entries, function(a, b)
        if a.distance ~= b.distance then return a.distance < b.distance end
        return a.number < b.number
    end)
    local result, kept = {}, {}
    for _, entry in ipairs(entries) do
        local known = false
        for j = #kept, 1, -1 do
            if entry.distance - kept[j].distance > TOLERANCE then break end
            known = known or isSame(entry.config, kept[j].config)
        end
        if not known then
            kept[#kept + 1], result[#result + 1] = entry, entry.config
        end
    end
    return result
end

--- The postures of a task: env, group, joints.
function configs.find(simIK, task, params, others)
    local maxTime = tonumber(params.maxTime) or 0.2
    if maxTime ~= maxTime then error("'maxTime' is no number.", 3) end
    local accept = configs.callable(params.cb)
    local all = table.move(others, 1, #others, 1, {})
    local function add(config)
        if accept and not accept(config, params.auxData) then return false end
        all[#all + 1] = config
        return true
    end
    search(simIK, task, math.abs(maxTime), accept ~= nil, function(config)
        if not add(config) then return false end
        if params.findAlt ~= false then
            for _, other in ipairs(configs.alternatives(simIK, task.env, task.joints, config)) do
                if not isSame(other, config) then add(other) end
            end
        end
        return not params.findMultiple
    end)
    return sorted(all, distances(simIK, task, params.cMetric))
end

return configs
