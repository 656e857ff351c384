--[[
Shared by sim/motion.lua and sim/pose.lua: checks and limits of a motion, the trajectory object behind it, and its execution.

Not a group of sim functions: those are in lua/library/sim.
]]

local sim = _quietRequire 'sim'
local M = {}

-- What 4.10 uses when no limit is passed at all: the motion becomes a jump.
local UNLIMITED <const> = {maxVel = 9999.0, maxAccel = 99999.0, maxJerk = 9999999.0}
local UNLIMITED_STEP <const> = 10.0
local BASE_CYCLE <const> = 0.0001
local PHASE_SYNC_DEFAULT <const> = -1
local RUNNING <const> = 0

function M.fill(value, n)
    local result = {}
    for i = 1, n do result[i] = value end
    return result
end

local function isCallable(value)
    local meta = type(value) == 'table' and getmetatable(value)
    return type(value) == 'function' or type(meta) == 'table' and meta.__call ~= nil
end

--- The function that a callback means: itself, or the one of that name when it is called.
function M.functionOf(callback)
    if type(callback) == 'string' then
        local found = require('var.functions').getvar(callback)
        return isCallable(found) and found or error("the callback '" .. callback .. "' is not a function.", 0)
    end
    return callback or function() end
end

local function invalid(field, level) error("invalid '" .. field .. "' field.", level + 1) end

--- Whether a value is a table of n finite numbers, or of at least n of them.
function M.isList(value, n, orMore)
    if type(value) ~= 'table' or #value < n or #value > n and not orMore then return false end
    for i = 1, #value do
        local x = value[i]
        if type(x) ~= 'number' or x - x ~= 0 then return false end
    end
    return true
end

local function isNumber(value) return M.isList({value}, 1) end

--- Raises an error unless a callback is a function, or perhaps the name of one.
function M.checkCallback(callback, level)
    if callback and type(callback) ~= 'string' and not isCallable(callback) then invalid('callback', level) end
end

--- A copy of the parameters, but for auxData, which the caller gets back as it is.
function M.copyParams(params, level)
    if type(params) ~= 'table' then error('the parameters of a motion are a table.', level) end
    local aux = params.auxData
    return require('copy').deepcopy(params, nil, type(aux) == 'table' and {[aux] = aux} or nil)
end

--- Checks and fills in what all motions have besides their limits: vel, accel and targetVel of n axes, flags, timeStep, callback.
function M.completeParams(data, n, level)
    for _, field in ipairs{'vel', 'accel', 'targetVel'} do
        data[field] = data[field] or M.fill(0.0, n)
        if not M.isList(data[field], n, true) then invalid(field, level) end
    end
    data.flags = math.tointeger(data.flags or PHASE_SYNC_DEFAULT) or invalid('flags', level)
    if not isNumber(data.timeStep) or data.timeStep < 0 then invalid('timeStep', level) end
    M.checkCallback(data.callback, level + 1)
    data.timeLeft = 0
end

local function completeMaximum(data, field, n, scalar, level)
    local value = data[field]
    if value == nil then error("missing '" .. field .. "' field.", level) end
    if isNumber(value) and scalar then
        data[field] = M.fill(value, n)
    elseif not M.isList(value, n) then
        invalid(field, level)
    end
end

local function completeMinimum(data, field, maximum, n, level)
    local value = data[field]
    if value == nil then
        data[field] = {}
        for i = 1, n do data[field][i] = -maximum[i] end
    elseif isNumber(value) then
        data[field] = M.fill(value, n)
    elseif not M.isList(value, n) then
        invalid(field, level)
    end
end

--- Fills in and checks maxVel, maxAccel, maxJerk, minVel and minAccel.
-- scalarVel: whether maxVel may be one number; 4.10 refuses that in moveToConfig and accepts it in moveToPose.
function M.completeLimits(data, n, scalarVel, level)
    if data.maxVel == nil and data.maxAccel == nil and data.maxJerk == nil then
        for field, value in pairs(UNLIMITED) do data[field] = M.fill(value, n) end
        data.timeStep = UNLIMITED_STEP
    end
    completeMaximum(data, 'maxVel', n, scalarVel, level + 1)
    completeMaximum(data, 'maxAccel', n, true, level + 1)
    completeMaximum(data, 'maxJerk', n, true, level + 1)
    completeMinimum(data, 'minVel', data.maxVel, n, level + 1)
    completeMinimum(data, 'minAccel', data.maxAccel, n, level + 1)
    data.timeStep = data.timeStep or 0
end

-- The maxima of the older form, and the minima behind them if the flag announces any.
local function split(limits, n, flags, flag)
    local maxima = table.move(limits, 1, n, 1, {})
    if flags < 0 or flags & flag == 0 or #limits < 2 * n then return maxima, nil end
    return maxima, table.move(limits, n + 1, 2 * n, 1, {})
end

--- Adds to params the arguments of the older form: limits, perhaps with minima, and a callback(data[field], vel, accel, auxData).
function M.addOlder(params, n, limits, callback, field, level)
    M.checkCallback(callback, level + 1)
    local flags = params.flags
    params.maxVel, params.minVel = split(limits.vel, n, flags, sim.ruckig_minvel)
    params.maxAccel, params.minAccel = split(limits.accel, n, flags, sim.ruckig_minaccel)
    params.maxJerk = table.move(limits.jerk, 1, n, 1, {})
    params.callback = function(data)
        return M.functionOf(callback)(data[field], data.vel, data.accel, data.auxData)
    end
end

local function timeStep(data) return data.timeStep == 0 and sim.getSimulationTimeStep() or data.timeStep end

-- The trajectory object accepts only multiples of its base cycle; time steps such as 1/240 s are none of 0.1 ms.
local function baseCycle(dt)
    local cycles = math.max(1, math.floor(dt / BASE_CYCLE + 0.5))
    local exact = math.abs(dt - cycles * BASE_CYCLE) < 1e-9
    return exact and BASE_CYCLE or dt / cycles
end

local function joined(tables, n)
    local result = {}
    for i, t in ipairs(tables) do table.move(t, 1, n, (i - 1) * n + 1, result) end
    return result
end

--- Creates the trajectory object for n degrees of freedom.
function M.start(data, n, current, targetPos, targetVel)
    local flags = (data.flags < 0 and sim.ruckig_phasesync or data.flags) | sim.ruckig_minvel | sim.ruckig_minaccel
    return sim.ruckigPos(
        n, baseCycle(timeStep(data)), flags, joined(current, n),
        joined({data.maxVel, data.maxAccel, data.maxJerk, data.minVel, data.minAccel}, n),
        M.fill(1, n), joined({targetPos, targetVel}, n)
    )
end

--- One time step: result and positions, velocities, accelerations; keeps data.timeLeft up to date.
function M.advance(data)
    local dt = timeStep(data)
    local result, state, remaining = sim.ruckigStep(data.ruckigObj, dt)
    if result == 0 then data.timeLeft = dt - remaining end
    return result, state
end

function M.finish(data)
    if data.ruckigObj then sim.ruckigRemove(data.ruckigObj) end
    data.ruckigObj = nil
end

--- Runs a motion to its end, a time step per simulation step. Resources are released also when a callback fails.
function M.run(data, step, cleanup)
    local stepping = sim.setStepping(true)
    local ending <close> = setmetatable({}, {__close = function()
        cleanup(data)
        sim.setStepping(stepping)
    end})
    local result
    repeat
        result = step(data)
        if result >= 0 then sim.step() end
    until result ~= RUNNING
    return result
end

return M
