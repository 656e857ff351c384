-- An arm whose camera has an inertia that no body can have, as robots' files have it: the arm holds, and bears the weight of both.
local bench = require 'lib.bench'

-- All nine numbers are equal (two moments are 0), or one moment is negative.
local EQUAL <const>, NEGATIVE <const> = {1, 1, 1, 1, 1, 1, 1, 1, 1}, {2.4, 6.1, 1.2, 6.1, 2.8, 0.8, 1.2, 0.8, 3.8}
local AT_ORIGIN <const> = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}

--- A horizontal arm of 5 kg, and on it a camera of a mass in kg, whose inertia is a multiple of numbers.
local function arm(y, mass, numbers, factor)
    local base = bench.body{at = {0, y, 1}, fixed = true}
    local joint = bench.joint{at = {0, y, 1}, parent = base, mode = sim.jointdynctrl_position, force = 100}
    local rod = bench.body{size = {0.4, 0.05, 0.05}, at = {0.2, y, 1}, mass = 5, parent = joint}
    local sensor = sim.createForceSensor(0, {0, 1, 0, 0, 0}, {0.01, 1, 1, 0, 0})
    sim.setObjectPosition(sensor, {0.4, y, 1})
    sim.setObjectParent(sensor, rod, true)
    local camera = bench.body{size = {0.05, 0.05, 0.05}, at = {0.4, y, 1}, mass = mass, parent = sensor}
    local inertia = {}
    for i, number in ipairs(numbers) do inertia[i] = number * factor end
    sim.setShapeInertia(camera, inertia, AT_ORIGIN)
    return joint
end

local joints = {
    ['0.1 kg, two moments 0'] = arm(0, 0.1, EQUAL, 1e-3),
    ['1e-6 kg, two moments 0'] = arm(1, 1e-6, EQUAL, 1e-6),
    ['1e-6 kg, a negative moment'] = arm(2, 1e-6, NEGATIVE, 1e-8),
}
local weights <const> = {['0.1 kg, two moments 0'] = 5 * 0.2 + 0.1 * 0.4}

bench.run(function()
    bench.untilTime(2)
    for _, case in ipairs{'0.1 kg, two moments 0', '1e-6 kg, two moments 0', '1e-6 kg, a negative moment'} do
        bench.check(case .. ': position of the joint, rad', sim.getJointPosition(joints[case]), 0, 1e-6)
        bench.check(case .. ': torque of the joint, N m', sim.getJointForce(joints[case]), bench.g * (weights[case] or 1), 1e-3)
    end
end)
