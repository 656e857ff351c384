-- Which of some balls lands first: one future for each question.
return {
    task = 'The balls /Ball1 to /Ball3 fall to the floor. Which one is the first to touch it, and when?',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    for i, height in ipairs {1.2, 0.5, 0.8} do
        local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
        sim.setObjectAlias(ball, 'Ball' .. i)
        sim.setObjectPosition(ball, {i, 0, height})
        sim.setBoolProperty(ball, 'dynamic', true)
        sim.setBoolProperty(ball, 'respondable', true)
    end
end
]==],
    solve = function(call)
        local first
        for i = 1, 3 do
            call('snapshot', {name = 'begin'})
            local values = call('run_until', {['until'] = {lua = string.format("sim.getObjectPosition(sim.getObject('/Ball%d'))[3] < 0.052", i)}, time = 3}).values
            call('restore', {name = 'begin'})
            if values.reached and (not first or values.time < first.time) then first = {name = '/Ball' .. i, time = values.time} end
        end
        return first
    end,
    check = function(_, answer)
        if not answer then return 'there is no answer' end
        if answer.name ~= '/Ball2' then return 'not ' .. answer.name end
        local expected = math.sqrt(2 * 0.45 / 9.81)
        if math.abs(answer.time - expected) > 0.06 then return 'not at ' .. answer.time end
    end,
}
