-- A force sensor between a base and a load: weight and moment.
local bench = require 'lib.bench'

local base = bench.body{at = {0, 0, 1}, fixed = true}
local sensor = sim.createForceSensor(0, {0, 1, 10, 0, 0}, {0.05, 100, 10, 0, 0})
sim.setObjectPosition(sensor, {0, 0, 1})
sim.setObjectParent(sensor, base, true)
local beam = bench.body{size = {0.2, 0.05, 0.05}, at = {0.1, 0, 1}, mass = 2, parent = sensor}
local joint = bench.joint{at = {0.2, 0, 1}, parent = beam, mode = sim.jointdynctrl_position, force = 100}
bench.body{size = {0.2, 0.05, 0.05}, at = {0.3, 0, 1}, mass = 1, parent = joint}

bench.run(function()
    bench.untilTime(0.5)
    local _, force, torque = sim.readForceSensor(sensor)
    bench.check('force along z, N', force[3], -3 * bench.g, 1e-6)
    bench.check('moment about y, N m', torque[2], (2 * 0.1 + 1 * 0.3) * bench.g, 1e-6)
    bench.check('force across, N', math.abs(force[1]) + math.abs(force[2]), 0, 1e-6)
end)
