-- A motor that nothing could stop turns a pendulum whose corners reach 2.5 mm below the floor; beside it one that is too weak to lift itself over, which stays.
local bench = require 'lib.bench'

bench.ground(1)

local function pendulum(y, torque)
    local base = bench.body{size = {0.1, 0.1, 0.1}, at = {0.075, y, 0.5}, fixed = true}
    local joint = bench.joint{at = {0.175, y, 0.5}, axis = 'x', parent = base, mode = sim.jointdynctrl_velocity, force = torque}
    bench.body{size = {0.1, 0.1, 0.5}, at = {0.175, y, 0.25}, mass = 5, solid = true, friction = 1, parent = joint}
    sim.setJointTargetVelocity(joint, 0.5)
    return joint
end

local strong, weak = pendulum(0, 10000), pendulum(2, 100)

bench.run(function()
    bench.untilTime(1)
    local at = sim.getJointPosition(strong)
    bench.untilTime(3)
    bench.check('10 kN m: speed after a second, rad/s', (sim.getJointPosition(strong) - at) / 2, 0.5, 0.005)
    bench.check('100 N m: angle after 3 s, rad', sim.getJointPosition(weak), 0, 0.005)
end)
