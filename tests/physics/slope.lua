-- Friction: the slope at which a box begins to slide, and its sliding distance on the horizontal.
local bench = require 'lib.bench'

local FRICTION <const> = 0.5
local boxes = {}
for i, slope in ipairs{math.atan(FRICTION) - math.rad(1), math.atan(FRICTION) + math.rad(1)} do
    local y = 5 * i
    bench.body{size = {4, 2, 0.1}, at = {0, y, 1}, turn = {0, slope, 0}, fixed = true, solid = true, friction = 1}
    local up = 0.05 + 0.05 + 1e-4
    local at = {up * math.sin(slope), y, 1 + up * math.cos(slope)}
    boxes[i] = bench.body{at = at, turn = {0, slope, 0}, mass = 1, solid = true, friction = FRICTION}
end

bench.ground(1)
local slider = bench.body{size = {0.3, 0.3, 0.1}, at = {0, -5, 0.05}, mass = 1, solid = true, friction = 0.3}
sim.setObjectFloatParam(slider, sim.shapefloatparam_init_velocity_x, 2)

bench.run(function()
    local start = {sim.getObjectPosition(boxes[1]), sim.getObjectPosition(boxes[2])}
    bench.untilTime(2)
    local function way(i)
        local p = sim.getObjectPosition(boxes[i])
        return math.sqrt((p[1] - start[i][1]) ^ 2 + (p[3] - start[i][3]) ^ 2)
    end
    bench.check('distance on a slope 1 deg below the angle of friction in 2 s, m', way(1), 0, 1e-3)
    local slope = math.atan(FRICTION) + math.rad(1)
    local friction = math.tan(slope) - way(2) / 2 / (bench.g * math.cos(slope))
    bench.check('friction, from the distance 1 deg above that angle in 2 s', friction, FRICTION, 0.005)
    bench.check('sliding distance, v^2 / 2 mu g, m', sim.getObjectPosition(slider)[1], 4 / (2 * 0.3 * bench.g), 0.01)
end)
