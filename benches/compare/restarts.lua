-- Starts, steps and stops the simulation of a chain of LINKS links ROUNDS times; prints the seconds of each on average.
sim = require 'sim'

local LENGTH <const> = 0.3

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

function sysCall_thread()
    sim.setStepping(true)
    local start = sim.getSystemTime()
    for _ = 1, ROUNDS do
        sim.startSimulation()
        sim.step()
        sim.stopSimulation(true)
    end
    print('RESTART ' .. (sim.getSystemTime() - start) / ROUNDS)
    sim.quitSimulator()
end
