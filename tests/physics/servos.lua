-- Motors: velocity with limited force, position by CoppeliaSim's control law, and a lift against gravity.
local bench = require 'lib.bench'

local function rig(x, type, mode, force, mass)
    local base = bench.body{at = {x, 0, 1}, fixed = true}
    local joint = bench.joint{type = type, axis = 'z', at = {x, 0, 1}, parent = base, mode = mode, force = force}
    bench.body{at = {x, 0, 1}, mass = mass, inertia = {0.01, 0.01, 0.01}, parent = joint}
    return joint
end

local wheel = rig(0, sim.joint_revolute, sim.jointdynctrl_velocity, 0.02)
sim.setJointTargetVelocity(wheel, 5)
local servo = rig(1, sim.joint_revolute, sim.jointdynctrl_position, 1000)
sim.setJointTargetPosition(servo, 0.1)
local lift = rig(2, sim.joint_prismatic, sim.jointdynctrl_velocity, 100, 3)
sim.setJointInterval(lift, false, {-1, 3})
sim.setJointTargetVelocity(lift, 0.2)

bench.run(function()
    sim.step()
    bench.check('position servo after 50 ms, 0.1 (1 - 0.9^10) rad', sim.getJointPosition(servo), 0.1 * (1 - 0.9 ^ 10), 1e-6)
    bench.untilTime(1)
    -- 0.02 N m on 0.01 kg m2: 2 rad/s2, until 5 rad/s are reached after 2.5 s.
    bench.check('wheel with limited torque after 1 s, rad/s', sim.getJointVelocity(wheel), 2, 1e-3)
    bench.check('torque of that motor, N m', -sim.getJointForce(wheel), 0.02, 1e-6)
    bench.untilTime(4)
    bench.check('wheel at its target velocity, rad/s', sim.getJointVelocity(wheel), 5, 1e-3)
    bench.check('distance of a lift after 4 s, m', sim.getJointPosition(lift), 0.8, 1e-3) -- two sub-steps to get going
    bench.check('force of the lift, m g, N', -sim.getJointForce(lift), 3 * bench.g, 1e-4)
end)
