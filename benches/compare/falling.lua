-- 31 bodies of the mesh FILE, which is not convex, fall so fast that rapier sweeps them; prints the seconds of a step on average.
sim = require 'sim'

local COUNT <const>, STEPS <const> = 31, 10

function sysCall_thread()
    local shape = sim.importShape(0, FILE, 0, 0, 1)
    sim.setBoolProperty(shape, 'dynamic', true)
    sim.setBoolProperty(shape, 'respondable', true)
    sim.setObjectFloatParam(shape, sim.shapefloatparam_init_velocity_z, -5)
    sim.setObjectFloatParam(shape, sim.shapefloatparam_init_velocity_a, 5)
    for i = 1, COUNT do
        local copy = i < COUNT and sim.copyPasteObjects({shape}, 0)[1] or shape
        sim.setObjectPosition(copy, {i % 6 * 0.6, i // 6 * 0.6, 5})
    end
    sim.setStepping(true)
    sim.startSimulation()
    sim.step()
    sim.step()
    local start = sim.getSystemTime()
    for _ = 1, STEPS do sim.step() end
    print('FALLS ' .. (sim.getSystemTime() - start) / STEPS)
    sim.quitSimulator()
end
