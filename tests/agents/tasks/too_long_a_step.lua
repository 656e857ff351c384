-- A simulation that is too coarse: the ball passes through a thin wall.
return {
    task = 'The quick ball /Ball passes through the thin wall /Wall. Choose the time step of the scene so that it does not (and no object is changed).',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.01, 1, 1})
    sim.setObjectAlias(wall, 'Wall')
    sim.setObjectPosition(wall, {1, 0, 0.5})
    sim.setBoolProperty(wall, 'respondable', true)
    local joint = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(joint, 'Barrel')
    local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'
-- A ball that flies on a straight line until its sensor reports the wall within the next step.
function sysCall_init() ball, wall = sim.getObject('/Ball'), sim.getObject('/Wall') x = 0 end
function sysCall_actuation()
    if sim.checkCollision(ball, wall) == 1 then stopped = true end
    if not stopped then x = x + 10 * sim.getSimulationTimeStep() end
    sim.setObjectPosition(ball, {x, 0, 0.5})
end
]])
    sim.setObjectAlias(script, 'Flight')
    local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.06, 0.06, 0.06})
    sim.setObjectAlias(ball, 'Ball')
    sim.setObjectPosition(ball, {0, 0, 0.5})
    sim.setFloatProperty(sim.handle_scene, 'timeStep', 0.15)
end
]==],
    solve = function(call)
        local found = call('find_properties', {object = 'scene', pattern = 'step'}).text
        assert(found:find('timeStep'), found)
        call('set_properties', {values = {['scene.timeStep'] = 0.002}})
    end,
    check = function(call)
        local rows = call('run_until', {time = 1, watch = {'/Ball.position[1]'}, every = 0.1}).values.samples.rows
        if rows[#rows][2] > 1.1 then return 'it is at ' .. rows[#rows][2] end
    end,
}
