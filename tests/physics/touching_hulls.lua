-- A convex mesh that touches pads to the last digit stays where it is; it is held with 4 % more than the critical force, and slips as Coulomb's law says with 4 % less.
local bench = require 'lib.bench'

local HALF <const>, MASS <const>, FRICTION <const> = 0.025, 0.1, 0.5

local function mesh(y)
    local vertices = {}
    for _, z in ipairs{-HALF, HALF} do
        for _, corner in ipairs{{-HALF, -HALF}, {HALF, -HALF}, {HALF, HALF}, {-HALF, HALF}} do
            for _, c in ipairs{corner[1], corner[2], z} do vertices[#vertices + 1] = c end
        end
    end
    local indices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7}
    local box = sim.createShape(0, 0, vertices, indices)
    sim.setObjectPosition(box, {0, y, 0})
    sim.setShapeMass(box, MASS)
    sim.setShapeInertia(box, {4e-5, 0, 0, 0, 4e-5, 0, 0, 0, 4e-5}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})
    sim.setBoolProperty(box, 'dynamic', true)
    sim.setBoolProperty(box, 'respondable', true)
    sim.setEngineFloatParam(sim.bullet_body_oldfriction, box, 1)
    return box
end

local function pad(y, side, parent)
    -- Turned by half a turn, so that its axes are not quite those of the mesh.
    local at = {side < 0 and -0.03 or 0.03, y, 0}
    return bench.body{size = {0.01, 0.02, 0.02}, at = at, turn = {0, 0, math.pi}, mass = 0.05, solid = true, friction = FRICTION, parent = parent, fixed = not parent}
end

local CASES <const> = {0.96, 1.04}
local held = {}
for index, factor in ipairs(CASES) do
    local y = index - 1
    local base = bench.body{size = {0.1, 0.1, 0.1}, at = {0, y, 0.3}, fixed = true}
    local force = factor * MASS * bench.g / (2 * FRICTION)
    local joint = bench.joint{type = sim.joint_prismatic, at = {0, y, 0}, axis = 'x', parent = base, mode = sim.jointdynctrl_velocity, force = force}
    sim.setJointInterval(joint, false, {-0.5, 1})
    sim.setJointTargetVelocity(joint, -0.05)
    pad(y, -1)
    pad(y, 1, joint)
    held[index] = mesh(y)
end
local alone = mesh(4)
pad(4, -1)

local function way(box, y)
    local at = sim.getObjectPosition(box)
    return math.sqrt(at[1] ^ 2 + (at[2] - y) ^ 2 + at[3] ^ 2)
end

bench.run(function()
    bench.gravity(0)
    bench.untilTime(0.5)
    bench.check('beside a pad without gravity: way, m', way(alone, 4), 0, 1e-6)
    for index in ipairs(CASES) do bench.check(('pressed with %g of the critical force: way, m'):format(CASES[index]), way(held[index], index - 1), 0, 1e-6) end
    bench.gravity(-bench.g)
    local function speed() return -sim.getVelocity(held[1])[3] end
    bench.untilTime(0.6)
    local before = speed()
    bench.untilTime(0.7)
    bench.check('acceleration of what slips, m/s2', (speed() - before) / 0.1, (1 - CASES[1]) * bench.g, 0.01)
    bench.untilTime(10.5)
    bench.check('way down of what is held for 10 s, m', -sim.getObjectPosition(held[2])[3], 0, 1e-5)
end)
