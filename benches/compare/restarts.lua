-- Starts, steps and stops the simulation of a chain of LINKS links ROUNDS times; prints the seconds of each on average, the steps that are made, of which a
-- stop takes some, and the seconds of each further step.
sim = require 'sim'

local LENGTH <const> = 0.3

local steps = 0
function sysCall_sensing() steps = steps + 1 end

function sysCall_init()
    local parent = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setBoolProperty(parent, 'dynamic', false)
    for i = 1, LINKS do
        local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
        local link = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.05, 0.05, LENGTH})
        sim.setBoolProperty(link, 'dynamic', true)
        sim.setObjectOrientation(joint, {math.pi / 2, 0, 0})
        sim.setObjectPosition(joint, {0, 0, LENGTH * (i - 0.5)})
        sim.setObjectPosition(link, {0, 0, LENGTH * i})
        sim.setObjectParent(joint, parent, true)
        sim.setObjectParent(link, joint, true)
        parent = link
    end
end

local function secondsOfRun(steps)
    local start = sim.getSystemTime()
    for _ = 1, ROUNDS do
        sim.startSimulation()
        for _ = 1, steps do sim.step() end
        sim.stopSimulation(true)
    end
    return (sim.getSystemTime() - start) / ROUNDS
end

function sysCall_thread()
    sim.setStepping(true)
    local one = secondsOfRun(1)
    print('RESTART ' .. one)
    print('STEPS ' .. steps // ROUNDS)
    local more = secondsOfRun(11)
    print('STEP ' .. (more - one) / 10)
    sim.quitSimulator()
end
