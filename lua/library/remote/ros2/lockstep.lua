--[[
`--ros2-lockstep`: a step is over when nodes have answered what it published, by messages of given topics. It is an add-on, after those that publish.
]]

local _, native = ...
local sim = require('sim')
local simROS2 = require('simROS2')

local M = {}

local function named(topics) return table.concat(topics, ', ') end

local function fail(format, ...)
    sim.stopSimulation()
    error(format:format(...), 0)
end

local hasBegun, hasFailed = false, false

--- Begins, also anew after its own error: the steps until the simulation has stopped are then not waited for.
function M.begin()
    sim.setBoolProperty(sim.handle_self, 'restartOnError', true)
    hasFailed = sim.getSimulationState() ~= sim.simulation_stopped
end

function M.beforeStart() hasBegun, hasFailed = false, false end

--- Waits for nodes that publish the topics, in the first step before anything is published.
function M.beforeStep(topics, timeout)
    if hasBegun or hasFailed then return end
    hasBegun = true
    local missing = native.awaitPublishers(topics, timeout)
    if #missing > 0 then
        fail('lock step: within %g s no node publishes %s, or no script subscribes to it.', timeout, named(missing))
    end
end

--- Waits for the answers to a step.
function M.afterStep(topics, timeout)
    if hasFailed then return end
    local stamp = simROS2.timeToFloat(simROS2.getSimulationTime())
    local late = native.awaitAnswers(topics, stamp, timeout)
    if #late > 0 then
        fail('lock step: %s has not answered the step at %.6g s within %g s. The simulation is stopped; --ros2-lockstep-timeout waits longer.', named(late), stamp, timeout)
    end
end

return M
