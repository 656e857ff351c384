-- What tumbles freely keeps its angular momentum and its energy, also about the axis of its middle moment of inertia.
local bench = require 'lib.bench'

bench.gravity(0)
-- Name, mass, moments of inertia, angular velocity.
local BODIES <const> = {
    {'1 kg at 8 rad/s', 1, {0.002, 0.004, 0.005}, {0.05, 8, 0.05}},
    {'5 g at 20 rad/s', 0.005, {1e-7, 4e-6, 4.08e-6}, {5, 20, 3}},
    {'a plate across x at 30 rad/s', 1, {0.02, 0.01, 0.0101}, {10, 20, 20}},
}
local bodies = {}
for index, it in ipairs(BODIES) do
    local body = bench.body{at = {index, 0, 0}, mass = it[2], inertia = it[3], turn = {0.1, 0.2, 0.3}}
    for axis, letter in ipairs{'a', 'b', 'g'} do
        sim.setObjectFloatParam(body, sim['shapefloatparam_init_velocity_' .. letter], it[4][axis])
    end
    bodies[index] = body
end

-- Angular momentum, and energy.
local function state(index)
    local inertia = BODIES[index][3]
    local _, w = sim.getVelocity(bodies[index])
    local m = sim.getObjectMatrix(bodies[index])
    local momentum, energy = {0, 0, 0}, 0
    for k = 1, 3 do
        local own = m[k] * w[1] + m[4 + k] * w[2] + m[8 + k] * w[3]
        energy = energy + inertia[k] * own ^ 2 / 2
        for i = 1, 3 do momentum[i] = momentum[i] + m[4 * i - 4 + k] * inertia[k] * own end
    end
    return momentum, energy
end

bench.run(function()
    sim.step()
    local before, energies, change, lost = {}, {}, {0, 0, 0}, {0, 0, 0}
    for index in ipairs(BODIES) do before[index], energies[index] = state(index) end
    while sim.getSimulationTime() < 20 do
        sim.step()
        for index in ipairs(BODIES) do
            local now, energy = state(index)
            local apart, all = 0, 0
            for k = 1, 3 do
                apart = apart + (now[k] - before[index][k]) ^ 2
                all = all + before[index][k] ^ 2
            end
            change[index] = math.max(change[index], math.sqrt(apart / all))
            lost[index] = math.max(lost[index], math.abs(energy / energies[index] - 1))
        end
    end
    for index, it in ipairs(BODIES) do
        bench.check(it[1] .. ': relative change of angular momentum', change[index], 0, 1e-4)
        bench.check('its energy, relative', lost[index], 0, 1e-4)
    end
end)
