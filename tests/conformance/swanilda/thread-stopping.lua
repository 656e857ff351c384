-- as: sandbox
-- passes: 0
-- loops: 60
-- spec: threads 5, threads 7, simulation 2; who may wait for the end of the simulation, and when the exit test of a thread is true
-- topic: threads
sim = require 'sim'

local function script(kind, code) return sim.createScript(kind, "sim = require 'sim'\n" .. code, 0, 'lua') end

local TELL <const> = [[
local function tell(what)
    print(what, sim.getSimulationState(), sim.getSimulationStopping(), sim.getThreadExistRequest(), sim.getThreadExitRequest())
end
]]

script(sim.scripttype_simulation, TELL .. [[
function sysCall_actuation() tell('step') end
function sysCall_thread()
    sim.step()
    sim.step()
    if sim.getInt32Signal('run') ~= 3 then return end
    sim.stopSimulation(true)
    tell('a simulation script does not wait')
end
]])

script(sim.scripttype_customization, TELL .. [[
function sysCall_suspend() tell('paused') end
function sysCall_suspended() sim.startSimulation() end

function sysCall_thread()
    tell('before')
    sim.setInt32Signal('run', 1)
    sim.startSimulation()
    sim.step()
    sim.step()
    sim.pauseSimulation()
    sim.step()
    sim.step()
    sim.step()
    sim.stopSimulation()
    tell('asked')
    sim.stopSimulation(true)
    tell('waited')
    sim.stopSimulation(true)
    tell('nothing to wait for')

    sim.setInt32Signal('run', 2)
    sim.startSimulation()
    sim.step()
    sim.step()
    sim.acquireLock()
    sim.stopSimulation(true)
    tell('cannot wait')
    sim.releaseLock()
    sim.stopSimulation(true)

    sim.setInt32Signal('run', 3)
    sim.startSimulation()
    while sim.getSimulationState() ~= sim.simulation_stopped do sim.step() end
    tell('end')
end
]])
