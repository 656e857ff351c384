-- A native plugin: a library in C, written for CoppeliaSim's plugin interface. Compile it first, beside this scene:
--
--     cc -shared -fPIC -Iinclude -o scenes/libsimHello.so examples/plugin_hello.c
--     swanilda run scenes/plugin_hello.lua
--
-- Without it the scene says what is missing.

sim = require 'sim'
local simHello = loadPlugin 'simHello'

function sysCall_init()
    if not simHello then return print('There is no libsimHello.so: the first lines of this scene say how to make it.') end
    print(simHello.func('Hello'), 'from ' .. simHello.language)
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(ball, {0, 0, 1})
    sim.setBoolProperty(ball, 'dynamic', true)
end

function sysCall_sensing()
    if not simHello then return sim.stopSimulation() end
    local height = simHello.height(ball)
    if height < 0.3 then
        print(('The ball has fallen to %.2f m.'):format(height))
        sim.stopSimulation()
    end
end
