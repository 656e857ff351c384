-- as: customization
-- passes: 0
-- loops: 30
-- spec: threads 5; scheduled functions: when, in which order, with what; throttled ones
-- topic: threads
sim = require 'sim'

local function say(...) print(string.format('%.2f', sim.getSimulationTime()), ...) end

function named(...) say('by name', select('#', ...), ...) end

local function throttled()
    local count, other = 0, 0
    local function more(n) count = count + n end
    for _ = 1, 3 do sim.throttle(1000, more, 2) end
    for _ = 1, 3 do sim.throttle(1000, function() other = other + 1 end) end
    print('throttled', count, other)
    for _ = 1, 3 do sim.throttle(-1, more, 1) end
    print('not throttled', count)
    local period = 1.5 * sim.getSystemTime() -- far more than what passes between two calls
    for _ = 1, 2 do sim.throttle(period, function() other = other + 1 end) end
    print('throttled', other)
end

function sysCall_init()
    throttled()
    print('unknown', sim.cancelScheduledExecution(1))
    sim.scheduleExecution(print, {'stopped, system time'}, 0)
    sim.scheduleExecution(say, {'simulation time: not before the simulation'}, 0, true)
end

local function batch()
    local first = sim.scheduleExecution(say, {'later'}, 0.08, true)
    print('numbers', sim.scheduleExecution(say, {'sooner'}, 0.06, true) - first)
    for i = 1, 8 do sim.scheduleExecution(say, {'same time', i}, 0.1, true) end
    sim.scheduleExecution('named', {1, nil, n = 2}, 0.1, true)
    sim.scheduleExecution('named', nil, 0.1, true)
    sim.scheduleExecution(say, {'system time'}, 0, false)
    sim.scheduleExecution(say, {'never: system time'}, sim.getSystemTime() + 1000)
    sim.scheduleExecution(say, {'never: simulation time'}, 1000, true)
    local cancelled = sim.scheduleExecution(say, {'never: cancelled'}, 0.1, true)
    print('cancelled', sim.cancelScheduledExecution(cancelled), sim.cancelScheduledExecution(cancelled))
    local victim
    sim.scheduleExecution(function() say('cancels', sim.cancelScheduledExecution(victim)) end, {}, 0.05, true)
    victim = sim.scheduleExecution(say, {'never: cancelled by another'}, 0.05, true)
    sim.scheduleExecution(function()
        say('adds')
        sim.scheduleExecution(say, {'added: a step later'}, 0, true)
    end, {}, 0.15, true)
    sim.scheduleExecution(function() say('cancels what is gone', sim.cancelScheduledExecution(victim)) end, {}, 0.15, true)
end

local steps, stopped = 0, 0

function sysCall_nonSimulation()
    stopped = stopped + 1
    if stopped == 2 and steps == 0 then sim.startSimulation() end
end

function sysCall_actuation()
    steps = steps + 1
    if steps == 1 then batch() end
    if steps == 5 then sim.pauseSimulation() end
    if steps == 7 then sim.stopSimulation() end
end

function sysCall_sensing() say('sensing') end

local paused = 0

function sysCall_suspend()
    sim.scheduleExecution(say, {'system time, paused'}, 0)
    sim.scheduleExecution(say, {'simulation time: not before the simulation goes on'}, 0, true)
end

function sysCall_suspended()
    paused = paused + 1
    say('suspended')
    if paused == 2 then sim.startSimulation() end
end
