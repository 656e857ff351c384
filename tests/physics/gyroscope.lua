-- Free rotation: angular momentum is conserved, and a torque-free top precesses at I3/I1 - 1 of its spin.
local bench = require 'lib.bench'

bench.gravity(0)
local I <const> = {0.02, 0.02, 0.03}
local top = bench.body{at = {0, 0, 1}, mass = 1, inertia = I}
local SPIN <const>, NUDGE <const> = 10, 0.5
sim.setObjectFloatParam(top, sim.shapefloatparam_init_velocity_a, NUDGE) -- about x
sim.setObjectFloatParam(top, sim.shapefloatparam_init_velocity_g, SPIN) -- about z

-- Angular velocity and momentum: in the body's axes, in the world's.
local function turning()
    local _, w = sim.getVelocity(top)
    local m = sim.getObjectMatrix(top)
    local own, momentum = {}, {0, 0, 0}
    for k = 1, 3 do own[k] = m[k] * w[1] + m[4 + k] * w[2] + m[8 + k] * w[3] end
    for k = 1, 3 do
        for i = 1, 3 do momentum[i] = momentum[i] + m[4 * i - 4 + k] * I[k] * own[k] end
    end
    return own, momentum
end

bench.run(function()
    sim.step()
    local _, before = turning()
    local phase, turned, t0 = nil, 0, sim.getSimulationTime()
    while sim.getSimulationTime() < 10 do
        sim.step()
        local own = turning()
        local now = math.atan(own[2], own[1])
        if phase then turned = turned + (now - phase + math.pi) % (2 * math.pi) - math.pi end
        phase = now
    end
    local _, after = turning()
    local apart = math.sqrt((after[1] - before[1]) ^ 2 + (after[2] - before[2]) ^ 2 + (after[3] - before[3]) ^ 2)
    bench.check('relative change of angular momentum in 10 s', apart / (I[3] * SPIN), 0, 0.02)
    local rate = turned / (sim.getSimulationTime() - t0 - 0.05)
    bench.check('precession in the body, rad/s', math.abs(rate), (I[3] / I[1] - 1) * SPIN, 0.05)
end)
