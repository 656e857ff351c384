-- The first minute: a scene is a Lua file, its functions are called by name.
--
--     swanilda run scenes/hello.lua
--
-- The file becomes a customization script: it lives before, during and after the simulation, so it may build
-- the scene first and act in it later.

sim = require 'sim'

function sysCall_init()
    moon = sim.createDummy(0.05)
    sim.setObjectAlias(moon, 'Moon')
    print('Hello! The scene holds ' .. #sim.getObjectsInTree(sim.handle_scene) .. ' objects. This is a new one: '
        .. sim.getObjectAlias(moon, 1))
end

-- Once per simulation step, before the physics.
function sysCall_actuation()
    local angle = math.pi * sim.getSimulationTime()
    sim.setObjectPosition(moon, {math.cos(angle), math.sin(angle), 0.5})
end

-- Once per simulation step, after the physics.
function sysCall_sensing()
    local t = sim.getSimulationTime()
    if (t + 1e-6) % 0.5 < 2e-6 then
        local p = sim.getObjectPosition(moon)
        print(string.format('t = %.1f s   the moon is at (%5.2f, %5.2f)', t, p[1], p[2]))
    end
    if t >= 2 then sim.stopSimulation() end
end

function sysCall_afterSimulation()
    local p = sim.getObjectPosition(moon)
    print(string.format('The simulation has ended, and all is where it began: (%.2f, %.2f)', p[1], p[2]))
end
