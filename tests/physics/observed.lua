-- A script that looks on at contacts and decides nothing: a stack of twenty boxes, one of ten with offsets, one with masks of its own.
local bench = require 'lib.bench'

bench.ground(0.71)

local function stack(x, count, offset, mask)
    local boxes = {}
    for i = 1, count do
        boxes[i] = bench.body{at = {x + i % 2 * offset, 0, 0.1 * i - 0.05}, mass = 0.5, solid = true, friction = 0.71}
        sim.setObjectInt32Param(boxes[i], sim.shapeintparam_respondable_mask, mask)
    end
    return boxes[count]
end

local tops = {{'twenty boxes', stack(0, 20, 0, 0xffff), 1.95}, {'ten with offsets', stack(2, 10, 0.01, 0xffff), 0.95},
              {'twenty with masks', stack(4, 20, 0, 0xfffe), 1.95}}
local calls = 0
function sysCall_contact() calls = calls + 1 end

bench.run(function()
    bench.untilTime(30)
    for i, top in ipairs(tops) do
        local p = sim.getObjectPosition(top[2])
        bench.check(top[1] .. ': height of the top after 30 s, m', p[3], top[3], 0.01)
        bench.check(top[1] .. ': its lateral displacement, m', math.abs(p[1] - 2 * (i - 1)), 0, 0.01)
    end
    bench.check('calls per sub-step', calls / 6000, 50, 3)
end)
