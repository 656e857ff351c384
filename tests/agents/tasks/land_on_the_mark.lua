-- A throw: a start value, found by comparing futures.
return {
    task = 'The ball /Ball starts at x = 0 in a height of 1 m, with the velocity initLinearVelocity, which is along x. It shall come down at x = 2 m (within 10 cm).',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(ball, 'Ball')
    sim.setObjectPosition(ball, {0, 0, 1})
    sim.setBoolProperty(ball, 'dynamic', true)
    sim.setBoolProperty(ball, 'respondable', true)
    sim.setVector3Property(ball, 'initLinearVelocity', {1, 0, 0})
end
]==],
    solve = function(call)
        local best
        for tenth = 30, 60, 3 do
            local answer = call('set_properties', {values = {['/Ball.initLinearVelocity'] = {tenth / 10, 0, 0}}})
            assert(not answer.isError, answer.text)
            local rows = call('run_until', {
                ['until'] = {lua = "sim.getObjectPosition(sim.getObject('/Ball'))[3] < 0.1"}, time = 3, watch = {'/Ball.position[1]'},
            }).values.samples.rows
            local off = math.abs(rows[#rows][2] - 2)
            if not best or off < best.off then best = {off = off, speed = tenth / 10} end
            call('simulation', {action = 'stop'})
        end
        call('set_properties', {values = {['/Ball.initLinearVelocity'] = {best.speed, 0, 0}}})
    end,
    check = function(call)
        local rows = call('run_until', {
            ['until'] = {lua = "sim.getObjectPosition(sim.getObject('/Ball'))[3] < 0.1"}, time = 3, watch = {'/Ball.position[1]'},
        }).values.samples.rows
        local x = rows[#rows][2]
        if math.abs(x - 2) > 0.1 then return 'it comes down at ' .. x end
    end,
}
