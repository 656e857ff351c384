-- Objects that move on paths of their own: which two meet.
return {
    task = 'The carriages /A, /B and /C move through each other without contacts. Which two of them overlap first, and when?',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    for name, place in pairs {A = {-1, 0, 0.5}, B = {1, 0, 0.5}, C = {0, 2, 0.5}} do
        local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.2})
        sim.setObjectAlias(box, name)
        sim.setObjectPosition(box, place)
    end
    local mover = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'
function sysCall_init() a, b, c = sim.getObject('/A'), sim.getObject('/B'), sim.getObject('/C') end
function sysCall_actuation()
    local t = sim.getSimulationTime()
    sim.setObjectPosition(a, {-1 + 0.2 * t, 0, 0.5})
    sim.setObjectPosition(b, {1 - 0.1 * t, 0, 0.5})
    sim.setObjectPosition(c, {0.6, 2 - 0.8 * t, 0.5})
end
]])
    sim.setObjectAlias(mover, 'Mover')
end
]==],
    solve = function(call)
        local first
        for _, pair in ipairs {{'/A', '/B'}, {'/A', '/C'}, {'/B', '/C'}} do
            local values = call('run_until', {['until'] = {collision = pair}, time = 20}).values
            if values.reached and (not first or values.time < first.time) then first = {pair = pair, time = values.time} end
            call('simulation', {action = 'stop'})
        end
        return first
    end,
    check = function(_, answer)
        if not answer then return 'there is no answer' end
        local pair = table.concat(answer.pair, ' ')
        if pair ~= '/B /C' or answer.time < 2 or answer.time > 3 then return pair .. ' at ' .. answer.time end
    end,
}
