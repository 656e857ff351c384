--[[
Stepping, waiting and scheduling.

Does not hold the yield counters or the pre-emption of threads: those are native (setAutoYield, setYieldAllowed).
]]

local sim = ...
local M = {}
local getYieldAllowed, setYieldAllowed, setAutoYield = getYieldAllowed, setYieldAllowed, setAutoYield
local running, yield = coroutine.running, coroutine.yield

local STOPPED <const>, ABOUT_TO_STOP <const>, LAST_BEFORE_STOP <const> = 0, 0x15, 0x16

local function canYield()
    if not getYieldAllowed() then return false end
    local _, isMain = running()
    return not isMain
end

--- Sets whether a thread is interrupted only where it asks for it (sim.step).
-- @api int prevLevel = sim.setStepping(bool enable)
-- @param enable true: one level more, false: one level less; an integer sets the level
-- @return prevLevel the level before, to be given back to this function later
function M.setStepping(enable)
    if math.type(enable) == 'integer' then return setAutoYield(enable) end
    return setAutoYield(not enable)
end

--- Hands over to the simulation until the next step. Returns at once outside of a thread.
-- @api sim.step()
function M.step()
    if canYield() then yield() end
end

--- Same as sim.step.
-- @api sim.yield()
function M.yield()
    if canYield() then yield() end
end

--- Forbids yielding and interruption until sim.releaseLock.
-- @api sim.acquireLock()
function M.acquireLock() setYieldAllowed(false) end

--- Undoes one sim.acquireLock.
-- @api sim.releaseLock()
function M.releaseLock() setYieldAllowed(true) end

local WAIT_ARGS = {{type = 'float'}, {type = 'bool', default = true}}

--- Waits until some time has passed.
-- Waiting for simulation time is possible in a thread only; elsewhere the time would never advance.
-- @api float timeLeft = sim.wait(float dt, bool simulationTime = true)
-- @param dt seconds
-- @param simulationTime false: wall-clock time
-- @return timeLeft overshoot in seconds, 0 for wall-clock time
function M.wait(...)
    local dt, simulationTime = require('checkargs.check')(WAIT_ARGS, ...)
    local now = simulationTime and sim.getSimulationTime or sim.getSystemTime
    local start = now()
    local elapsed = 0.0
    while elapsed < dt do
        if simulationTime and not canYield() then
            error('sim.wait: cannot wait here: not in a thread, or yielding is forbidden', 2)
        end
        M.step()
        elapsed = now() - start
    end
    return simulationTime and elapsed - dt or 0
end

local function checkCanWait(level)
    if canYield() then return end
    error('sim.waitForSignal: cannot wait here: not in a thread, or yielding is forbidden', level + 1)
end

local function waitForOldSignal(name)
    while true do
        local value = sim.getInt32Signal(name) or sim.getFloatSignal(name) or sim.getStringSignal(name)
        if value then return value end
        checkCanWait(3)
        M.step()
    end
end

--- Waits until a signal exists and is not false.
-- The form without target waits for an old-style integer, float or string signal.
-- @api any value = sim.waitForSignal(int target, string signalName)
-- @param target object or other handle that holds the signal, for instance sim.handle_scene
-- @param signalName name without the prefix signal.
-- @return value the value of the signal, which stays set
function M.waitForSignal(target, signalName)
    if signalName == nil then
        local value = waitForOldSignal(target)
        return value
    end
    while true do
        local value = sim.getProperty(target, 'signal.' .. signalName, {noError = true})
        if value then return value end
        checkCanWait(2)
        M.step()
    end
end

--- Asks for the end of the simulation; some more steps follow.
-- @api sim.stopSimulation(bool wait = false)
-- @param wait wait until stopped, at most 20 steps; not possible in main and simulation scripts
function M.stopSimulation(wait)
    sim._stopSimulation()
    if not wait or not canYield() then return end
    local kind = sim.getIntProperty(sim.handle_self, 'scriptType', {noError = true})
    if kind == sim.scripttype_main or kind == sim.scripttype_simulation then return end
    for _ = 1, 20 do
        if sim.getSimulationState() == STOPPED then return end
        M.step()
    end
end

--- Whether the simulation is stopped or about to stop: the exit test of a loop in a thread.
-- @api bool stopping = sim.getSimulationStopping()
-- @return stopping true from the second-last step on
function M.getSimulationStopping()
    local state = sim.getSimulationState()
    return state == STOPPED or state == ABOUT_TO_STOP or state == LAST_BEFORE_STOP
end

--- Old name of sim.getSimulationStopping, misspelt.
-- @api bool stopping = sim.getThreadExistRequest()
-- @return stopping true from the second-last step on
function M.getThreadExistRequest() return M.getSimulationStopping() end

--- Old name of sim.getSimulationStopping.
-- @api bool stopping = sim.getThreadExitRequest()
-- @return stopping true from the second-last step on
function M.getThreadExitRequest() return M.getSimulationStopping() end

---------------------------------------------------------------- scheduling

local queue -- entries sorted by nothing: there are few, and they may be cancelled
local lastId = 0

local function runDue(simulationTime, now)
    local due = {}
    for _, entry in pairs(queue) do
        if entry.simulationTime == simulationTime and entry.at <= now then due[#due + 1] = entry end
    end
    table.sort(due, function(a, b)
        if a.at ~= b.at then return a.at < b.at end
        return a.id < b.id
    end)
    for _, entry in ipairs(due) do
        if queue[entry.id] then
            queue[entry.id] = nil
            local f = type(entry.func) == 'string' and _G[entry.func] or entry.func
            f(table.unpack(entry.args, 1, entry.args.n or #entry.args))
        end
    end
end

local function handleQueue()
    if next(queue) == nil then return end
    runDue(false, sim.getSystemTime())
    if sim.getSimulationState() == sim.simulation_advancing_running then runDue(true, sim.getSimulationTime()) end
end

--- Runs a function later, at a point in time.
-- @api int id = sim.scheduleExecution(func f, any[] args, float timePoint, bool simulationTime = false)
-- @param f function or name of a global function
-- @param args its arguments
-- @param timePoint seconds, of sim.getSystemTime or sim.getSimulationTime
-- @param simulationTime which of the two
-- @return id for sim.cancelScheduledExecution
function M.scheduleExecution(f, args, timePoint, simulationTime)
    if not queue then
        queue = {}
        for _, callback in ipairs{'sysCall_nonSimulation', 'sysCall_sensing', 'sysCall_suspended'} do
            registerScriptFuncHook(callback, handleQueue, true)
        end
    end
    lastId = lastId + 1
    queue[lastId] = {
        id = lastId, func = f, args = args or {}, at = timePoint, simulationTime = simulationTime and true or false,
    }
    return lastId
end

--- Cancels a scheduled function.
-- @api bool cancelled = sim.cancelScheduledExecution(int id)
-- @param id from sim.scheduleExecution
-- @return cancelled false if it has run already, or never existed
function M.cancelScheduledExecution(id)
    local known = queue ~= nil and queue[id] ~= nil
    if known then queue[id] = nil end
    return known
end

local lastRun = {} -- bytecode of the function -> time; the same function written twice in a loop is one function

--- Calls a function, but not more often than once per period; other calls do nothing.
-- @api sim.throttle(float period, func f, ...)
-- @param period seconds of wall-clock time
-- @param f the function; the rest are its arguments
function M.throttle(period, f, ...)
    local key, now = string.dump(f), sim.getSystemTime()
    if lastRun[key] and now - lastRun[key] < period then return end
    lastRun[key] = now
    f(...)
end

return M
