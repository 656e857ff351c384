-- Two fingers on a base that does not move hold what is between them as hard as those on a lift.
local bench = require 'lib.bench'

local function finger(base, x, y, direction, force, size)
    local joint = bench.joint{type = sim.joint_prismatic, at = {x, y, 1}, axis = 'x', parent = base, mode = sim.jointdynctrl_velocity, force = force}
    sim.setJointInterval(joint, false, {-0.2, 0.4})
    local at = {x + direction * (size / 2 + 0.012), y, 1}
    local tip = bench.body{size = {0.02, 0.05, 0.05}, at = at, mass = 0.1, solid = true, friction = 1, parent = joint}
    sim.setJointTargetVelocity(joint, -0.1 * direction)
    return tip
end

local CASES <const> = {{20, 0.02}, {50, 0.005}, {200, 0.1}, {1000, 0.1}}
local hands = {}
for index, case in ipairs(CASES) do
    local y, size = index, 0.04
    local base = bench.body{size = {0.1, 0.1, 0.1}, at = {0, y, 1.3}, fixed = true}
    local held = bench.body{size = {size, size, size}, at = {0, y, 1}, mass = case[2], solid = true, friction = 1}
    hands[index] = {held = held, left = finger(base, 0, y, -1, case[1], size), right = finger(base, 0, y, 1, case[1], size), size = size}
end

bench.run(function()
    bench.untilTime(1)
    for _, hand in ipairs(hands) do hand.height = sim.getObjectPosition(hand.held)[3] end
    bench.untilTime(5)
    for index, case in ipairs(CASES) do
        local hand = hands[index]
        local apart = sim.getObjectPosition(hand.right)[1] - sim.getObjectPosition(hand.left)[1] - 0.02
        local name = ('%g N on %g kg'):format(case[1], case[2])
        bench.check(name .. ': way the fingers sink in, m', hand.size - apart, 0, 1e-4)
        bench.check('its way down in 4 s, m', hand.height - sim.getObjectPosition(hand.held)[3], 0, 6e-6)
    end
end)
