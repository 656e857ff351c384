-- topic: scripts
-- as: sandbox
-- passes: 1
-- spec: callbacks 4, vrep-era 2.11
-- note: what main scripts call: how many scripts ran, and who may call it
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function script(kind, name, code)
    local handle = sim.createScript(kind, "sim = require 'sim'\n" .. code, 0, 'lua')
    sim.setObjectAlias(handle, name)
    return handle
end
local SIMULATION, CUSTOMIZATION = sim.scripttype_simulation, sim.scripttype_customization
local ACTUATION = "function sysCall_actuation(...) print('in', '%s', ...) end"
script(SIMULATION, 'one', ACTUATION:format('one'))
script(SIMULATION, 'two', ACTUATION:format('two'))
sim.setBoolProperty(script(SIMULATION, 'off', ACTUATION:format('off')), 'scriptDisabled', true)
script(SIMULATION, 'without', 'function sysCall_cleanup() end')
script(CUSTOMIZATION, 'custom', ACTUATION:format('custom'))
script(SIMULATION, 'asks', [[
function sysCall_sensing()
    local function refused(f, ...) print('refused', (tostring(select(2, pcall(f, ...))):match('([^: ][^:]*%.)$'))) end
    refused(sim.handleAddOnScripts, sim.syscb_sensing)
    refused(sim.handleCustomizationScripts, sim.syscb_sensing)
    refused(sim.handleSandboxScript, sim.syscb_sensing)
    refused(sim.handleSensingStart)
    refused(sim.launchThreadedChildScripts)
    refused(sim.resumeThreads, 0)
    print('silent', sim.handleSimulationScripts(sim.syscb_sensing), sim.handleChildScripts(sim.syscb_sensing))
end
]])
function sysCall_actuation(...) print('in', 'sandbox', ...) end

sim.setStringProperty(sim.handle_mainscript, 'code', [[
sim = require 'sim'
function sysCall_init() print('start', sim.handleSimulationStart()) end
function sysCall_actuation()
    if isDone then return end
    print('launched', sim.launchThreadedChildScripts(), sim.resumeThreads(0))
    print('simulation', sim.handleSimulationScripts(sim.syscb_actuation, 'first'))
    print('child', sim.handleChildScripts(sim.syscb_actuation, 'second', 2))
    print('customization', sim.handleCustomizationScripts(sim.syscb_actuation, 'third'))
    print('add-ons', sim.handleAddOnScripts(sim.syscb_actuation))
    print('sandbox', select('#', sim.handleSandboxScript(sim.syscb_actuation, 'fourth')))
end
function sysCall_sensing()
    if isDone then return end
    isDone = true
    print('sensing', sim.handleSensingStart())
    sim.handleSimulationScripts(sim.syscb_sensing)
end
]])
