-- A robot of an MJCF file. Named parameters: `file`; `step`, the sub-step of the physics, and `time`, the step of the simulation, in seconds.
sim = require 'sim'

local function param(name) return tonumber(sim.getNamedStringParam(name)) end

function sysCall_init()
    sim.setFloatParam(sim.floatparam_simulation_time_step, param('time'))
    sim.setFloatParam(sim.floatparam_physicstimestep, param('step'))
    sim.setInt32Param(sim.intparam_dynamic_engine, sim.physics_mujoco)
    sim.loadModel(sim.getNamedStringParam('file'))
end
