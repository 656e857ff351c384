-- Contacts are as hard under heavy bodies as under light ones: 100 kg on 1 kg.
local bench = require 'lib.bench'

bench.ground(1)
local light = bench.body{at = {0, 0, 0.05}, mass = 1, solid = true, friction = 1}
local heavy = bench.body{at = {0, 0, 0.15}, mass = 100, solid = true, friction = 1}

bench.run(function()
    bench.untilTime(10)
    bench.check('the light box sinks by, m', 0.05 - sim.getObjectPosition(light)[3], 0, 1e-3)
    bench.check('the heavy box sinks by, m', 0.15 - sim.getObjectPosition(heavy)[3], 0, 2e-3)
    bench.check('tilt of the heavy box, rad', sim.getObjectOrientation(heavy)[1], 0, 1e-3)
end)
