--[[
The standard simulation interfaces of ROS 2 (simulation_interfaces 2.1.0), for `--ros2`: services and an action by which nodes control the
simulation, its entities and worlds; and robots with their topics (`remote.ros2.robots`). It is an add-on, which also publishes /clock, /tf and /joint_states of what
is no such robot.

A service runs in a coroutine, since some answer later: when steps were made, or when the simulation has stopped. A simulation that is paused
by a client is held before its next step, so that neither a step nor a tick of the clock comes.
]]

local _, native = ...
local sim = require('sim')
local simROS2 = require('simROS2')
local results = require('remote.ros2.results')
local entities = require('remote.ros2.entities')
local spawning = require('remote.ros2.spawning')
local worlds = require('remote.ros2.worlds')
local initial = require('remote.ros2.initial_state')
local bridge = require('swanilda.ros2_bridge')
local robots = require('remote.ros2.robots')

local STOPPED <const>, PLAYING <const>, PAUSED <const>, QUITTING <const>, NO_WORLD <const> = 0, 1, 2, 3, 4
local NAMES <const> = {[0] = 'stopped', 'playing', 'paused', 'quitting', 'no world', 'loading a world'}
local ALREADY <const>, INCORRECT_TRANSITION <const> = 101, 103

local M = {}

---------------------------------------------------------------- states

local isHeld, isQuitting = false, false
local left = 0 -- steps that a held simulation may make

local function state()
    if isQuitting then return QUITTING end
    local now = sim.getSimulationState()
    if now == sim.simulation_stopped then return worlds.current() and STOPPED or NO_WORLD end
    if isHeld or now == sim.simulation_paused then return PAUSED end
    return PLAYING
end

---------------------------------------------------------------- coroutines that wait

local waiting = {} -- { isDue, coroutine }

local function resume(thread)
    local ok, isDue = coroutine.resume(thread)
    if not ok then return sim.addLog(sim.verbosity_scripterrors, tostring(isDue)) end
    if coroutine.status(thread) ~= 'dead' then waiting[#waiting + 1] = {isDue = isDue, thread = thread} end
end

local function await(isDue)
    while not isDue() do coroutine.yield(isDue) end
end

local function resumeDue()
    local before = waiting
    waiting = {}
    for _, one in ipairs(before) do
        if one.isDue() then resume(one.thread) else waiting[#waiting + 1] = one end
    end
end

local function isStopped() return sim.getSimulationState() == sim.simulation_stopped end

local function stop()
    isHeld, left = false, 0
    if not isStopped() then
        sim.stopSimulation()
        await(isStopped)
    end
end

local function start(held)
    isHeld, left = held, 0
    sim.startSimulation()
    await(function() return not isStopped() and sim.getSimulationState() ~= sim.simulation_paused end)
end

---------------------------------------------------------------- control

local transitions = {
    [STOPPED] = stop,
    [PLAYING] = function()
        if isHeld then isHeld = false else start(false) end
    end,
    [PAUSED] = function()
        if isStopped() then start(true) else isHeld = true end
    end,
    [QUITTING] = function()
        isQuitting = true
        sim.quitSimulator()
    end,
}

local function setState(request)
    local target = request.state.state
    local transition = transitions[target]
    if target == state() then return results.failed(ALREADY, ('the simulation is %s already'):format(NAMES[target])) end
    if not transition then
        local name = NAMES[target] or tostring(target)
        return results.failed(INCORRECT_TRANSITION, ("'%s' is not set as a state: load_world and unload_world do that"):format(name))
    end
    if target ~= QUITTING and not worlds.current() then
        return results.failed(results.INCORRECT_STATE, 'there is no world: load one first')
    end
    transition()
    return results.ok()
end

local isStepping = false

-- Why no steps can be made now.
local function refusal()
    if state() ~= PAUSED then return ('steps are made while the simulation is paused; it is %s'):format(NAMES[state()]) end
    if isStepping then return 'other steps are being made' end
end

-- Makes steps, each followed by `each(done)`, until that returns true.
local function step(count, each)
    isStepping, isHeld = true, true
    if sim.getSimulationState() == sim.simulation_paused then sim.startSimulation() end
    local done = 0
    while done < count and isHeld do
        left = 1
        await(function() return left == 0 or not isHeld end)
        if not isHeld then break end
        done = done + 1
        if each(done) then break end
    end
    isStepping = false
    return done
end

local function stepSimulation(request)
    local reason = refusal()
    if reason then return results.failed(results.OPERATION_FAILED, reason) end
    local done = step(request.steps, function() end)
    if done == request.steps then return results.ok() end
    return results.failed(results.OPERATION_FAILED, ('the simulation was stopped or resumed after %d of %d steps'):format(done, request.steps))
end

---------------------------------------------------------------- steps as an action

local steps -- the server of the action

local function makeSteps(id, goal)
    local reason = refusal()
    if reason then return simROS2.actionServerActionAbort(steps, id, results.failed(results.OPERATION_FAILED, reason)) end
    local isCancelled
    local done = step(goal.steps, function(done)
        simROS2.actionServerPublishFeedback(steps, id, {completed_steps = done, remaining_steps = goal.steps - done})
        isCancelled = simROS2.actionServerActionIsCanceling(steps, id)
        return isCancelled
    end)
    if isCancelled then
        simROS2.actionServerActionCanceled(steps, id, results.failed(results.OPERATION_FAILED, ('cancelled after %d steps'):format(done)))
    elseif done < goal.steps then
        simROS2.actionServerActionAbort(steps, id, results.failed(results.OPERATION_FAILED, ('ended after %d steps'):format(done)))
    else
        simROS2.actionServerActionSucceed(steps, id, results.ok())
    end
end

---------------------------------------------------------------- reset

local SCOPE_TIME <const>, SCOPE_STATE <const>, SCOPE_SPAWNED <const> = 1, 2, 4

local function reset(request)
    local scope = request.scope == 0 and 0xff or request.scope
    local has = function(bit) return scope & bit ~= 0 end
    if has(SCOPE_TIME) and not has(SCOPE_STATE) then
        return results.failed(results.FEATURE_UNSUPPORTED, 'time begins anew together with the state only: scope 3')
    end
    if has(SCOPE_SPAWNED) then spawning.removeAll() end
    local before = state()
    if has(SCOPE_TIME) and (before == PLAYING or before == PAUSED) then
        stop()
        start(before == PAUSED)
    elseif has(SCOPE_STATE) then
        initial.restore()
    end
    return results.ok()
end

---------------------------------------------------------------- features

-- Numbers of the message SimulatorFeatures.
local FEATURES <const> = {
    0, 1, 2, 4, 5, 6, 8, 9, 10, 11, 12, 13, 14, 20, 21, 22, 23, 24, 25, 26, 31, 32, 33, 40, 41, 43, 44, 45, 50,
}
local ABOUT <const> = 'Swanilda. Entities are objects without a parent: models and shapes. Named poses are dummies without a parent. '
    .. 'Time is reset together with the state. Accelerations are neither measured nor set.'

local function features()
    return {features = {features = FEATURES, spawn_formats = spawning.FORMATS, custom_info = ABOUT}}
end

---------------------------------------------------------------- services

local SERVICES <const> = {
    GetSimulatorFeatures = features,
    GetSimulationState = function() return {state = {state = state()}, result = results.OK} end,
    SetSimulationState = setState,
    StepSimulation = stepSimulation,
    ResetSimulation = reset,
    GetEntities = entities.list,
    GetEntitiesStates = entities.listStates,
    GetEntityState = entities.state,
    SetEntityState = entities.setState,
    GetEntityInfo = entities.info,
    SetEntityInfo = entities.setInfo,
    GetEntityBounds = entities.bounds,
    DeleteEntity = entities.delete,
    GetNamedPoses = entities.namedPoses,
    GetNamedPoseBounds = entities.namedPoseBounds,
    SpawnEntity = spawning.spawn,
    SpawnEntities = spawning.spawnAll,
    GetSpawnables = spawning.list,
    LoadWorld = function(request)
        stop()
        return worlds.load(request)
    end,
    UnloadWorld = function()
        stop()
        return worlds.unload()
    end,
    GetCurrentWorld = worlds.get,
    GetAvailableWorlds = worlds.list,
}

local function snakeCase(name) return (name:gsub('(%l)(%u)', '%1_%2'):lower()) end

local function serve(name, handler)
    local service
    local function answer(request, number)
        local ok, response = pcall(handler, request)
        if not ok then response = results.failed(results.OPERATION_FAILED, results.reason(response)) end
        native.respond(service, number, response)
    end
    service = native.createService('/' .. snakeCase(name), 'simulation_interfaces/srv/' .. name, function(request, number)
        resume(coroutine.create(function() answer(request, number) end))
    end)
end

---------------------------------------------------------------- the add-on

--- Creates the servers; without a node of ROS 2 that is an error of the add-on. `settings` is the TOML file of a robot, or nil.
function M.start(settings)
    setAutoYield(false)
    entities.matches = native.matches
    bridge.start()
    robots.start(settings)
    spawning.attach, worlds.hasLoaded = robots.attachFile, robots.lookAgain
    for name, handler in pairs(SERVICES) do serve(name, handler) end
    steps = simROS2.createActionServer('/simulate_steps', 'simulation_interfaces/action/SimulateSteps',
        function() return simROS2.goal_response.accept_and_execute end,
        function() return simROS2.cancel_response.accept end,
        function(id, goal) resume(coroutine.create(function() makeSteps(id, goal) end)) end)
end

--- The hooks of the add-on.
function M.wait()
    resumeDue()
    robots.look()
end

function M.beforeStart()
    robots.look()
    initial.note()
end

M.actuate = robots.actuate

function M.afterStep()
    bridge.publish(robots.owned())
    robots.sense()
    entities.afterStep()
end

--- Whether the next step is held back.
function M.beforeStep()
    resumeDue()
    local isHeldBack = isHeld and left == 0
    left = math.max(0, left - 1)
    return isHeldBack
end

function M.afterEnd()
    isHeld, left = false, 0
    robots.reset()
    resumeDue()
end

return M
