-- Inverse kinematics: by its module, or by hand.
return {
    task = 'Move the joints /Shoulder and /Elbow of the planar arm so that its tip /Tip is at x = 0.5, y = 0.6 (within 1 cm).',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local shoulder = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(shoulder, 'Shoulder')
    local elbow = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(elbow, 'Elbow')
    sim.setObjectPosition(elbow, {0.6, 0, 0})
    sim.setObjectParent(elbow, shoulder, true)
    local tip = sim.createDummy(0.02)
    sim.setObjectAlias(tip, 'Tip')
    sim.setObjectPosition(tip, {1, 0, 0})
    sim.setObjectParent(tip, elbow, true)
end
]==],
    solve = function(call)
        local answer = call('run_code', {code = [[
local shoulder, elbow, tip = sim.getObject('/Shoulder'), sim.getObject('/Elbow'), sim.getObject('/Tip')
local x, y, a, b = 0.5, 0.6, 0.6, 0.4
local bend = math.acos((x * x + y * y - a * a - b * b) / (2 * a * b))
sim.setJointPosition(elbow, bend)
sim.setJointPosition(shoulder, math.atan(y, x) - math.atan(b * math.sin(bend), a + b * math.cos(bend)))
return sim.getObjectPosition(tip)
]]})
        assert(not answer.isError, answer.text)
    end,
    check = function(call)
        local at = call('get_properties', {items = {'/Tip.position'}}).values.values['/Tip.position']
        local off = math.sqrt((at[1] - 0.5) ^ 2 + (at[2] - 0.6) ^ 2)
        if off > 0.01 then return 'it is ' .. off .. ' m away' end
    end,
}
