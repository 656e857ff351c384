-- A joint that does not reach its target: its interval is too small.
return {
    task = 'The joint /Door shall open to 1.2 rad, its target, but stops earlier. Find the reason, and remove it.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local door = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(door, 'Door')
    sim.setObjectPosition(door, {0, 0, 0.5})
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(base, 'Base')
    sim.setObjectPosition(base, {-0.1, 0, 0.5})
    sim.setObjectParent(door, base, true)
    sim.setJointInterval(door, false, {0, 0.4})
    sim.setIntProperty(door, 'dynCtrlMode', sim.jointdynctrl_position)
    sim.setJointTargetForce(door, 100)
    sim.setJointTargetPosition(door, 1.2)
    local panel = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.4, 0.02, 0.8})
    sim.setObjectAlias(panel, 'Panel')
    sim.setObjectPosition(panel, {0.2, 0, 0.5})
    sim.setBoolProperty(panel, 'dynamic', true)
    sim.setObjectParent(panel, door, true)
end
]==],
    solve = function(call)
        call('run_until', {time = 2})
        local joint = call('joints').values.joints[1]
        assert(joint.high < joint.target)
        call('simulation', {action = 'stop'})
        call('set_properties', {values = {['/Door.interval'] = {0, 1.5}}})
    end,
    check = function(call)
        local values = call('run_until', {['until'] = {joint = {joint = '/Door', position = 1.2, tolerance = 0.02}}, time = 5}).values
        if not values.reached then return 'it does not get there' end
    end,
}
