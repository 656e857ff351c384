-- A mass on a spring with a damper: its step response.
local bench = require 'lib.bench'

bench.gravity(0)
local MASS <const>, K <const>, C <const> = 1, 40, 2
local base = bench.body{at = {0, 0, 1}, fixed = true}
local joint = bench.joint{
    type = sim.joint_prismatic, axis = 'z', at = {0, 0, 1}, parent = base, mode = sim.jointdynctrl_spring, interval = {-1, 1},
}
bench.body{at = {0, 0, 1}, mass = MASS, parent = joint}
sim.setObjectFloatParam(joint, sim.jointfloatparam_kc_k, K)
sim.setObjectFloatParam(joint, sim.jointfloatparam_kc_c, C)
sim.setJointTargetPosition(joint, 0.1)

bench.run(function()
    local decay, omega = C / (2 * MASS), math.sqrt(K / MASS - (C / (2 * MASS)) ^ 2)
    local function response(t) return 0.1 * (1 - math.exp(-decay * t) * (math.cos(omega * t) + decay / omega * math.sin(omega * t))) end
    for _, t in ipairs{0.25, 0.5, 1, 2, 4} do
        bench.untilTime(t)
        bench.check(('position at %.2f s, m'):format(t), sim.getJointPosition(joint), response(t), 0.004)
    end
end)
