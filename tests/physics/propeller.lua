-- Propellers at 5000 rad/s, four turns in a sub-step: driven with limited torque, on a free body that turns in reaction, and free.
local bench = require 'lib.bench'

local SPEED <const>, TORQUE <const> = 5000, 10
local BLADE <const>, HULL <const> = 1e-3, 0.1 -- inertia about z, kg m2

bench.gravity(0)
local function propeller(x, base)
    local joint = bench.joint{at = {x, 0, 1}, axis = 'z', parent = base, mode = sim.jointdynctrl_velocity, force = TORQUE,
        interval = {-1e5, 2e5}}
    local blade = bench.body{size = {0.4, 0.02, 0.01}, at = {x, 0, 1}, mass = 0.1, inertia = {BLADE / 2, BLADE / 2, BLADE}, parent = joint}
    sim.setJointTargetVelocity(joint, SPEED)
    return joint, blade
end
local fixed = propeller(0, bench.body{at = {0, 0, 1}, fixed = true})
local hull = bench.body{at = {1, 0, 1}, mass = 1, inertia = {HULL, HULL, HULL}}
local flying, blade = propeller(1, hull)
local tilted = bench.body{at = {3, 0, 1}, mass = 1, inertia = {HULL, HULL, HULL}}
local held, rotor = propeller(3, tilted)
for body, spin in pairs{[tilted] = 0, [rotor] = SPEED} do
    sim.setObjectFloatParam(body, sim.shapefloatparam_init_velocity_a, 1)
    sim.setObjectFloatParam(body, sim.shapefloatparam_init_velocity_g, spin)
end
-- Angular momentum of a hull with its propeller, whose inertia across is half of that about its axis.
local function momentum(of, blades)
    local _, w = sim.getVelocity(of)
    local _, v = sim.getVelocity(blades)
    local m = sim.getObjectMatrix(blades)
    local along = v[1] * m[3] + v[2] * m[7] + v[3] * m[11]
    local l = {}
    for i = 1, 3 do l[i] = HULL * w[i] + BLADE / 2 * (v[i] + along * m[4 * i - 1]) end
    return l
end
local free = bench.body{at = {2, 0, 1}, mass = 0.1, inertia = {BLADE / 2, BLADE / 2, BLADE}}
sim.setObjectFloatParam(free, sim.shapefloatparam_init_velocity_g, SPEED)

bench.run(function()
    sim.step()
    local start = momentum(tilted, rotor)
    bench.untilTime(0.25)
    bench.check('speed after 0.25 s with limited torque, rad/s', sim.getJointVelocity(fixed), TORQUE / BLADE * 0.25, 1)
    bench.untilTime(2)
    local _, spin = sim.getVelocity(free)
    local _, hullSpin = sim.getVelocity(hull)
    local _, bladeSpin = sim.getVelocity(blade)
    bench.check('final speed, rad/s', sim.getJointVelocity(fixed), SPEED, 1e-3)
    bench.check('angle in 2 s, rad', sim.getJointPosition(fixed), SPEED * 2 - SPEED ^ 2 * BLADE / TORQUE / 2, 15)
    bench.check('speed of the body in reaction, rad/s', hullSpin[3], -SPEED * BLADE / (BLADE + HULL), 1e-3)
    bench.check('angular momentum of both, N m s', HULL * hullSpin[3] + BLADE * bladeSpin[3], 0, 1e-6)
    local change = 0
    for i, l in ipairs(momentum(tilted, rotor)) do change = change + (l - start[i]) ^ 2 end
    bench.check('change of the angular momentum of one that nods, of 5 N m s', math.sqrt(change), 0, 0.1)
    bench.check('position of the body, m', sim.getObjectPosition(hull)[1], 1, 1e-6)
    bench.check('speed of the free propeller, rad/s', spin[3], SPEED, 1e-3)
end)
