-- A cart on one driven wheel and two casters, balls on ball joints, turns about itself; so it does with casters that slide freely.
local bench = require 'lib.bench'

local RADIUS <const>, TRACK <const> = 0.08, 0.15
bench.ground(1)

local function cart(y, friction)
    local chassis = bench.body{size = {0.4, 0.3, 0.06}, at = {0, y, 0.1}, mass = 2}
    local axle = bench.joint{at = {-0.1, y + TRACK, RADIUS}, parent = chassis, mode = sim.jointdynctrl_velocity, force = 5}
    bench.body{
        kind = sim.primitiveshape_cylinder, size = {2 * RADIUS, 2 * RADIUS, 0.03}, at = {-0.1, y + TRACK, RADIUS},
        turn = {math.pi / 2, 0, 0}, mass = 0.3, solid = true, friction = 1, parent = axle,
    }
    sim.setJointTargetVelocity(axle, 3)
    for _, at in ipairs{{0.1, 0}, {-0.1, -TRACK}} do
        local place = {at[1], y + at[2], 0.03}
        local ball = bench.joint{type = sim.joint_spherical, at = place, parent = chassis}
        bench.body{
            kind = sim.primitiveshape_spheroid, size = {0.06, 0.06, 0.06}, at = place, mass = 0.1, solid = true,
            friction = friction, parent = ball,
        }
    end
    return chassis
end

local rolling, sliding = cart(0, 1), cart(3, 0)

bench.run(function()
    bench.untilTime(3)
    -- Other engines turn it by 0.8 to 1.2 rad, without friction by 1.02 (MuJoCo).
    bench.check('yaw of one with casters without friction after 3 s, rad', sim.getObjectOrientation(sliding)[3], -1.1, 0.15)
    bench.check('yaw of one with rolling casters, rad', sim.getObjectOrientation(rolling)[3], -1.1, 0.15)
end)
