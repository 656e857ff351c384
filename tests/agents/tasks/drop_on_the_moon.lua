-- A setting of the scene.
return {
    task = 'Let the scene be on the moon: a ball that is dropped from 1 m there needs 1.11 s to the ground.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(ball, 'Ball')
    sim.setObjectPosition(ball, {0, 0, 1.05})
    sim.setBoolProperty(ball, 'dynamic', true)
    sim.setBoolProperty(ball, 'respondable', true)
end
]==],
    solve = function(call)
        local found = call('find_properties', {object = 'scene', pattern = 'gravity'}).text
        assert(found:match('^gravity = %(0, 0, %-9.81%)'), found)
        call('set_properties', {values = {['scene.gravity'] = {0, 0, -1.62}}})
    end,
    check = function(call)
        local values = call('run_until', {['until'] = {lua = "sim.getObjectPosition(sim.getObject('/Ball'))[3] < 0.06"}, time = 5}).values
        if not values.reached or math.abs(values.time - 1.11) > 0.1 then return 'it took ' .. values.time .. ' s' end
    end,
}
