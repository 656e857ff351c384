-- A measured quantity: the braking distance of a sliding box.
return {
    task = 'The box /Sledge slides along x with 2 m/s when the simulation starts. How far does it slide until it stands?',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.3, 0.3, 0.1})
    sim.setObjectAlias(box, 'Sledge')
    sim.setObjectPosition(box, {-1.5, 0, 0.0501})
    sim.setBoolProperty(box, 'dynamic', true)
    sim.setBoolProperty(box, 'respondable', true)
    sim.setVector3Property(box, 'initLinearVelocity', {2, 0, 0})
end
]==],
    solve = function(call)
        call('step', {count = 2})
        local run = call('run_until', {
            ['until'] = {lua = "math.abs(sim.getObjectVelocity(sim.getObject('/Sledge'))[1]) < 0.001"}, time = 10, watch = {'/Sledge.position[1]'},
        }).values
        local rows = run.samples.rows
        return run.reached and rows[#rows][2] + 1.5
    end,
    check = function(call, answer)
        if not answer then return 'there is no answer' end
        call('simulation', {action = 'stop'})
        local rows = call('run_until', {time = 6, watch = {'/Sledge.position[1]'}}).values.samples.rows
        local distance = rows[#rows][2] - rows[1][2]
        if distance < 0.05 or math.abs(answer - distance) > 0.01 then return string.format('%g m, not %g m', distance, answer) end
    end,
}
