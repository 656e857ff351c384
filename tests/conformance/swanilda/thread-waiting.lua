-- as: simulation
-- passes: 20
-- spec: threads 5; sim.wait: when it ends, what it returns, where it is refused; the times are whole steps of 0.05 s
-- topic: threads
sim = require 'sim'

local function waited(dt)
    local start = sim.getSimulationTime()
    local over = sim.wait(dt)
    print(string.format('wait %.2f took %.3f, %.3f over', dt, sim.getSimulationTime() - start, over))
end

local function refused(what, f)
    local _, message = xpcall(f, function(message) return message end)
    print(what, message)
end

function sysCall_init()
    local start = sim.getSystemTime()
    print('system time', sim.wait(0.01, false), sim.getSystemTime() - start >= 0.01)
    refused('no thread', function() sim.wait(0.1) end)
    refused('simulation time by name', function() sim.wait(0.1, true) end)
    print('nothing to wait for', sim.wait(0), sim.wait(-1))
end

function sysCall_thread()
    print('levels', sim.setStepping(true), sim.setStepping(true), sim.setStepping(false), sim.setStepping(5), sim.setStepping(0))
    waited(0.1)
    waited(0.12)
    waited(0)
    waited(-1)
    sim.acquireLock()
    refused('locked', function() sim.wait(0.1) end)
    refused('locked', function() sim.waitForSignal('nobody') end)
    refused('locked', function() sim.waitForSignal(sim.handle_scene, 'nobody') end)
    local start = sim.getSimulationTime()
    sim.step()
    sim.yield()
    print('locked, steps', sim.getSimulationTime() - start)
    sim.releaseLock()
    sim.step()
    sim.yield()
    print(string.format('free, steps %.2f', sim.getSimulationTime() - start))
    start = sim.getSimulationTime()
    refused('an impossible motion', function() sim.moveToConfig{pos = {0}, targetPos = {1}, maxVel = {1}, maxAccel = {0}, maxJerk = {1}} end)
    print('takes no step', sim.getSimulationTime() - start)
end
