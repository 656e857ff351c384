-- A gripper that lets its object go.
return {
    task = 'The gripper /Lift lifts, but the block /Block slips out of its fingers. Make the gripper hold it.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local function box(alias, size, place, mass, parent)
        local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
        sim.setObjectAlias(h, alias)
        sim.setObjectPosition(h, place)
        sim.setShapeMass(h, mass)
        sim.setBoolProperty(h, 'dynamic', true)
        sim.setBoolProperty(h, 'respondable', true)
        if parent then sim.setObjectParent(h, parent, true) end
        return h
    end
    local function slider(alias, place, euler, interval, parent, force)
        local h = sim.createJoint(sim.joint_prismatic, sim.jointmode_dynamic, 0)
        sim.setObjectAlias(h, alias)
        sim.setObjectPosition(h, place)
        sim.setObjectOrientation(h, euler)
        sim.setJointInterval(h, false, interval)
        sim.setIntProperty(h, 'dynCtrlMode', sim.jointdynctrl_velocity)
        sim.setJointTargetForce(h, force)
        if parent then sim.setObjectParent(h, parent, true) end
        return h
    end
    local lift = slider('Lift', {0, 0, 0.5}, {0, 0, 0}, {0, 1}, nil, 500)
    local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(base, 'Base')
    sim.setObjectPosition(base, {0, 0, 1.8})
    sim.setObjectParent(lift, base, true)
    local palm = box('Palm', {0.05, 0.3, 0.05}, {0, 0, 0.5}, 1, lift)
    local left = slider('Left', {0, -0.12, 0.4}, {-math.pi / 2, 0, 0}, {0, 0.2}, palm, 0.5)
    box('LeftFinger', {0.05, 0.02, 0.1}, {0, -0.12, 0.38}, 0.1, left)
    local right = slider('Right', {0, 0.12, 0.4}, {math.pi / 2, 0, 0}, {0, 0.2}, palm, 0.5)
    box('RightFinger', {0.05, 0.02, 0.1}, {0, 0.12, 0.38}, 0.1, right)
    box('Block', {0.05, 0.1, 0.1}, {0, 0, 0.35}, 0.5)
    local table = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.1, 0.3})
    sim.setObjectAlias(table, 'Table')
    sim.setObjectPosition(table, {0, 0, 0.15})
    sim.setBoolProperty(table, 'respondable', true)
    local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'
function sysCall_actuation()
    local t = sim.getSimulationTime()
    sim.setJointTargetVelocity(sim.getObject('/Left'), 0.1)
    sim.setJointTargetVelocity(sim.getObject('/Right'), 0.1)
    sim.setJointTargetVelocity(sim.getObject('/Lift'), (t > 1.5 and t < 4) and 0.1 or 0)
end
]])
    sim.setObjectAlias(script, 'Program')
end
]==],
    solve = function(call)
        -- Do the fingers press at all?
        call('run_until', {time = 1.2})
        local forces = call('joints', {root = '/Lift'}).values.joints
        local weak = {}
        for _, joint in ipairs(forces) do if joint.limit and joint.limit < 5 then weak[#weak + 1] = joint.path end end
        call('simulation', {action = 'stop'})
        local values = {}
        for _, path in ipairs(weak) do values[path .. '.targetForce'] = 40 end
        local answer = call('set_properties', {values = values})
        assert(not answer.isError, answer.text)
    end,
    check = function(call)
        local rows = call('run_until', {time = 5, watch = {'/Block.position[3]'}}).values.samples.rows
        local height = rows[#rows][2]
        if height < 0.5 then return 'the block is at a height of ' .. height .. ' m' end
    end,
}
