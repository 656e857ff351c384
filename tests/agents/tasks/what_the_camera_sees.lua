-- What can be seen from a place, and what hides behind something else.
return {
    task = 'Which of the things /Red, /Green and /Blue can be seen from the point (3, 0, 0.5), looking at the origin?',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    for name, place in pairs {Red = {0, -0.5, 0.5}, Green = {-1, 0.5, 0.5}, Blue = {0, 0.5, 0.5}} do
        local size = name == 'Blue' and 0.5 or 0.1
        local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {size, size, size})
        sim.setObjectAlias(box, name)
        sim.setObjectPosition(box, place)
    end
end
]==],
    solve = function(call)
        local seen = {}
        local answer = call('picture', {eye = {3, 0, 0.5}, target = {0, 0, 0.5}})
        assert(answer.pictures == 1)
        for _, label in ipairs(answer.values.labels) do seen[label.path] = true end
        return seen
    end,
    check = function(_, answer)
        if not answer then return 'there is no answer' end
        if not answer['/Red'] or not answer['/Blue'] or answer['/Green'] then return 'these were said to be seen: ' .. (next(answer) or 'none') end
    end,
}
