-- as: customization
-- passes: 8
-- engine: bullet278
-- spec: dynamics 1; the physics step changes only while the simulation is stopped, by whatever name
-- tol: 1e-9
-- topic: dynamics
sim = require 'sim'

local ways = {
    function(step) sim.setFloatParam(sim.floatparam_physicstimestep, step) end,
    function(step) sim.setFloatProperty(sim.handle_scene, 'dynamicsStepSize', step) end,
    function(step) sim.setEngineFloatParam(sim.bullet_global_stepsize, -1, step) end,
    function(step) sim.setEngineFloatParam(sim.ode_global_stepsize, -1, step) end,
    function(step) sim.setEngineFloatParam(sim.vortex_global_stepsize, -1, step) end,
    function(step) sim.setEngineFloatParam(sim.newton_global_stepsize, -1, step) end,
    function(step) sim.setEngineFloatParam(37001, -1, step) end,
}

local function show(when)
    local steps = {}
    for i, way in ipairs(ways) do
        pcall(way, i / 1000)
        steps[i] = string.format('%.3f', sim.getFloatParam(sim.floatparam_physicstimestep))
    end
    print(when, table.concat(steps, ' '), string.format('%.3f', sim.getEngineFloatParam(sim.bullet_global_stepsize, -1)))
end

function sysCall_init()
    show('stopped')
    pcall(sim.setEngineFloatParam, sim.bullet_global_stepsize, -1, 1)
    print('at most the simulation step', sim.getFloatParam(sim.floatparam_physicstimestep))
    sim.setFloatParam(sim.floatparam_physicstimestep, 0.005)
    print('no number', pcall(sim.setEngineFloatParam, sim.bullet_global_stepsize, -1, 0 / 0))
end

local passes = 0
function sysCall_sensing()
    passes = passes + 1
    if passes == 2 then show('running') end
end

function sysCall_afterSimulation() show('stopped again') end
