-- as: sandbox
-- passes: 1
-- spec: vrep-era 2.8, simulation 7; what main scripts of old scenes call and what they get
-- topic: old functions
sim = require 'sim'
sim.setStringProperty(sim.handle_mainscript, 'code', [[
sim = require 'sim'
function sysCall_init() sim.handleSimulationStart() end
function sysCall_actuation()
    if said then return end
    said = true
    print('threads', sim.resumeThreads(0), sim.launchThreadedChildScripts())
    print('various', sim.handleVarious(), sim.handleMechanism(sim.handle_all_except_explicit))
end
]])
