-- A gripper that is open to its upper limits closes by a joint callback, and holds a box.
local bench = require 'lib.bench'

local OPEN <const>, FORCE <const> = 0.082, 20

local hand = bench.body{size = {0.05, 0.2, 0.05}, at = {0, 0, 1}, fixed = true, solid = true, mask = 0xff01, friction = 1}
local joints = {}
for i, side in ipairs{-1, 1} do
    local joint = sim.createJoint(sim.joint_prismatic, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(joint, {0.08, 0, 1})
    sim.setObjectOrientation(joint, {-side * math.pi / 2, 0, 0})
    sim.setObjectParent(joint, hand, true)
    sim.setJointInterval(joint, false, {0, OPEN})
    sim.setJointPosition(joint, OPEN)
    local finger = bench.body{size = {0.1, 0.02, 0.03}, at = {0.08, side * OPEN, 1}, mass = 0.1, solid = true, friction = 1}
    sim.setObjectParent(finger, joint, true)
    sim.setIntProperty(joint, 'dynCtrlMode', sim.jointdynctrl_callback)
    joints[i] = joint
end
local box = bench.body{size = {0.04, 0.1, 0.04}, at = {0.1, 0, 1}, mass = 0.2, solid = true, friction = 1}
-- Beside a finger, touching it.
bench.body{size = {0.1, 0.02, 0.03}, at = {0.08, OPEN + 0.02, 1}, fixed = true, solid = true, friction = 0}
local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'
function sysCall_init() end
function sysCall_joint(data) return {force = ]] .. FORCE .. [[, velocity = CLOSING or 0} end
function close() CLOSING = -0.1 end
]])
sim.setObjectParent(script, hand, true)

bench.run(function()
    bench.gravity(0)
    sim.step()
    bench.check('finger at its limit after a step, m', sim.getJointPosition(joints[1]), OPEN, 1e-4)
    bench.check('the other one, which touches something, m', sim.getJointPosition(joints[2]), OPEN, 1e-4)
    sim.callScriptFunction('close', script)
    bench.untilTime(1)
    bench.gravity(-9.81)
    bench.untilTime(5)
    bench.check('finger at a box 0.1 m wide, m', sim.getJointPosition(joints[1]), 0.06, 1e-3)
    bench.check('force of the motor, N', math.abs(sim.getJointForce(joints[1])), FORCE, 0.1)
    bench.check('height of the box after 4 s, m', sim.getObjectPosition(box)[3], 1, 1e-3)
end)
