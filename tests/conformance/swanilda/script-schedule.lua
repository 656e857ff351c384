-- topic: threads
-- as: simulation
-- passes: 6
-- spec: threads 5; functions that run later, and not too often
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
local ids = {}

local function late(what, ...) print(what, string.format('%.2f', sim.getSimulationTime()), ...) end

function sysCall_init()
    print('stopping', sim.getThreadExitRequest())
    -- Due at once, but the first step, which is not `running` yet, goes by.
    ids.zero = sim.scheduleExecution(late, {'at 0'}, 0, true)
    ids.tenth = sim.scheduleExecution(late, {'at 0.1', 1, 'two', {3}}, 0.1, true)
    ids.before = sim.scheduleExecution(late, {'at 0.07'}, 0.07, true)
    ids.cancelled = sim.scheduleExecution(late, {'never'}, 0.1, true)
    ids.never = sim.scheduleExecution(late, {'never'}, 1e9, true)
    -- By the wall clock: 0 has passed long ago, so that it runs at the first chance.
    sim.scheduleExecution(late, {'by the clock'}, 0)
    sim.scheduleExecution(late, {'never'}, sim.getSystemTime() + 1e6, false)
    print('cancel', sim.cancelScheduledExecution(ids.cancelled), sim.cancelScheduledExecution(ids.cancelled), sim.cancelScheduledExecution(123456))
end

local counts = {hour = 0, other = 0, always = 0}

local function throttled()
    for i = 1, 3 do
        sim.throttle(3600, function(n) counts.hour = counts.hour + n end, i)
        sim.throttle(3600, function(n) counts.other = counts.other - n end, i)
        sim.throttle(0, function(n) counts.always = counts.always + n end, i)
    end
end

function sysCall_sensing()
    local time = sim.getSimulationTime()
    if time > 0.17 then return end
    late('sensing')
    throttled()
    if time < 0.12 then return end
    -- Only the first call in an hour of each function ran, with its argument 1; always 1 + 2 + 3 in four steps.
    print('counts', counts.hour, counts.other, counts.always)
    print('over', sim.cancelScheduledExecution(ids.tenth), sim.cancelScheduledExecution(ids.never), sim.getThreadExitRequest())
end

function sysCall_cleanup() print('stopping', sim.getThreadExitRequest()) end
