-- Ten boxes on top of each other for a minute.
local bench = require 'lib.bench'

bench.ground(0.71)
local boxes = {}
for i = 1, 10 do
    boxes[i] = bench.body{at = {0, 0, 0.1 * i - 0.05}, mass = 0.5, solid = true, friction = 0.71}
end

bench.run(function()
    bench.untilTime(60)
    local top = sim.getObjectPosition(boxes[10])
    bench.check('height of the top box after 60 s, m', top[3], 0.95, 0.01)
    bench.check('its lateral displacement, m', math.sqrt(top[1] ^ 2 + top[2] ^ 2), 0, 1e-3)
    local v = sim.getVelocity(boxes[10])
    bench.check('its speed, m/s', math.sqrt(v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2), 0, 1e-4)
end)
