-- Rebounds of bodies of any form: what leaves the ground has the restitution's share of its speed, and nothing gains energy.
local bench = require 'lib.bench'

bench.ground(0.5, 1)
-- Name, kind, size, orientation, restitution, height.
local FORMS <const> = {
    {'ball', 'spheroid', {0.1, 0.1, 0.1}, {0, 0, 0}},
    {'flat box', 'cuboid', {0.2, 0.3, 0.1}, {0, 0, 0}},
    {'standing cylinder', 'cylinder', {0.1, 0.1, 0.2}, {0, 0, 0}},
    {'tilted box', 'cuboid', {0.2, 0.3, 0.1}, {0.3, 0.4, 0}},
    {'lying capsule', 'capsule', {0.1, 0.1, 0.3}, {0, math.pi / 2, 0}},
    {'tilted capsule', 'capsule', {0.1, 0.1, 0.3}, {0, 1, 0}},
    {'tilted cylinder', 'cylinder', {0.1, 0.1, 0.2}, {0.5, 0.2, 0}},
}
local drops = {}
for index, form in ipairs(FORMS) do
    for number, restitution in ipairs{1, 0.3} do
        local body = bench.body{
            kind = sim['primitiveshape_' .. form[2]], size = form[3], at = {index, 2 * number, 1.2}, turn = form[4], mass = 1, solid = true,
            friction = 0.5, bounce = restitution,
        }
        drops[#drops + 1] = {name = form[1], body = body, restitution = restitution, top = 0, bounces = 0, gain = 0, isFlat = index <= 3}
    end
end
local low = bench.body{kind = sim.primitiveshape_spheroid, size = {0.1, 0.1, 0.1}, at = {-1, 0, 0.25}, mass = 1, solid = true, bounce = 1}

local function height(body) return sim.getObjectPosition(body)[3] end

bench.run(function()
    for _, drop in ipairs(drops) do
        drop.start, drop.energy, drop.rest = height(drop.body), bench.energy(drop.body), sim.getObjectFloatParam(drop.body, sim.objfloatparam_modelbbox_max_z)
    end
    local lowTop, before = 0, {}
    while sim.getSimulationTime() < 5 do
        sim.step()
        for _, drop in ipairs(drops) do
            local v, w = sim.getVelocity(drop.body)
            if before[drop] and before[drop] < -0.5 and v[3] > 0.1 then
                drop.bounces = drop.bounces + 1
                if drop.bounces == 1 then drop.ratio, drop.spin = v[3] / -before[drop], math.sqrt(w[1] ^ 2 + w[2] ^ 2 + w[3] ^ 2) end
            end
            if drop.bounces == 5 then drop.top = math.max(drop.top, height(drop.body)) end
            before[drop] = v[3]
            drop.gain = math.max(drop.gain, bench.energy(drop.body) / drop.energy - 1)
        end
        if sim.getSimulationTime() > 4 then lowTop = math.max(lowTop, height(low)) end
    end
    for _, drop in ipairs(drops) do
        local name = string.format('%s, restitution %g', drop.name, drop.restitution)
        -- Sampled at the ends of steps, so that energy is that of the integrator, g h v / 2 beside the true one.
        bench.check(name .. ': energy gained, relative', drop.gain, 0, 0.025)
        if drop.isFlat then
            bench.check(name .. ': spin after the first rebound, rad/s', drop.spin, 0, 0.01)
            if drop.restitution == 1 then bench.check(name .. ': height after five rebounds, m', drop.top, drop.start, 0.012) end
        end
    end
    bench.check('ball dropped by 20 cm, restitution 1: height after 4 s, m', lowTop, 0.25, 0.006)
end)
