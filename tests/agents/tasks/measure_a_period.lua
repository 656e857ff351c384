-- A measurement over time: from samples to a number.
return {
    task = 'Measure the period of the pendulum /Axis, in seconds.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local axis = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(axis, 'Axis')
    sim.setObjectPosition(axis, {0, 0, 2})
    sim.setObjectOrientation(axis, {-math.pi / 2, 0, 0})
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(base, 'Base')
    sim.setObjectPosition(base, {0, 0, 2.2})
    sim.setObjectParent(axis, base, true)
    sim.setIntProperty(axis, 'dynCtrlMode', sim.jointdynctrl_free)
    local angle, length = 0.15, 1
    local rod = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.02, 0.02, length})
    sim.setObjectAlias(rod, 'Rod')
    sim.setObjectPosition(rod, {-math.sin(angle) * length / 2, 0, 2 - math.cos(angle) * length / 2})
    sim.setObjectOrientation(rod, {0, angle, 0})
    sim.setBoolProperty(rod, 'dynamic', true)
    sim.setObjectParent(rod, axis, true)
    sim.setFloatProperty(sim.handle_scene, 'timeStep', 0.01)
end
]==],
    solve = function(call)
        local rows = call('run_until', {time = 8, watch = {'/Rod.position[1]'}, rows = 500, every = 0.02}).values.samples.rows
        local crossings = {}
        for i = 2, #rows do
            local a, b = rows[i - 1], rows[i]
            if a[2] < 0 and b[2] >= 0 then crossings[#crossings + 1] = a[1] + (b[1] - a[1]) * a[2] / (a[2] - b[2]) end
        end
        return (crossings[#crossings] - crossings[1]) / (#crossings - 1)
    end,
    check = function(_, answer)
        if not answer then return 'there is no answer' end
        -- Of a rod: 2 pi sqrt(2 l / 3 g).
        local expected = 2 * math.pi * math.sqrt(2 / 3 / 9.81)
        if math.abs(answer - expected) > 0.03 * expected then return string.format('%g s, not %g s', expected, answer) end
    end,
}
