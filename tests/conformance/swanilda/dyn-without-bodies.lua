-- topic: dynamics
-- as: simulation
-- passes: 2
-- spec: dynamics 1
-- note: the sub-steps are counted where nothing moves, but not where the physics is off
sim = require 'sim'
local pass = 0
function sysCall_actuation()
    pass = pass + 1
    if pass ~= 1 then return end
    print('enabled', sim.handleDynamics(sim.getSimulationTimeStep()))
    print('no time', sim.handleDynamics(0))
    sim.setBoolParam(sim.boolparam_dynamics_handling_enabled, false)
    print('off', sim.handleDynamics(sim.getSimulationTimeStep()))
end
