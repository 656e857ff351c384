-- The add-on that does what the options of the command line say: `options` has starts, time (seconds of simulated time), quits,
-- arguments (texts) and code.
local sim = require 'sim'
local has_begun = false

local function run_code()
    local sandbox = sim.getScript(sim.scripttype_sandbox)
    local done, reason = pcall(sim.executeScriptString, options.code, sandbox)
    if not done then sim.addLog(sim.verbosity_scripterrors, '-c: ' .. reason) end
end

function sysCall_init()
    for number, text in ipairs(options.arguments) do
        sim.setStringParam(sim.stringparam_app_arg1 + number - 1, text)
    end
end

function sysCall_nonSimulation()
    if has_begun then return end
    has_begun = true
    if options.code ~= '' then run_code() end
    if options.starts then sim.startSimulation() end
end

function sysCall_sensing()
    if sim.getSimulationTime() + sim.getSimulationTimeStep() >= options.time then sim.stopSimulation() end
end

function sysCall_afterSimulation()
    if options.quits then sim.quitSimulator() end
end
