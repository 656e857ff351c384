-- A search over objects and their properties.
return {
    task = 'Which of the boxes below /Store is the heaviest, and how heavy is it?',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local store = sim.createDummy(0.1)
    sim.setObjectAlias(store, 'Store')
    for i = 1, 8 do
        local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        sim.setObjectAlias(box, 'Box' .. i)
        sim.setShapeMass(box, ({3, 1, 4, 1.5, 9, 2.6, 5, 3.5})[i])
        sim.setObjectParent(box, store, true)
    end
end
]==],
    solve = function(call)
        local items = {}
        for _, object in ipairs(call('find_objects', {root = '/Store', type = 'shape'}).values.objects) do items[#items + 1] = object.path .. '.mass' end
        local best
        for item, mass in pairs(call('get_properties', {items = items}).values.values) do
            if not best or mass > best.mass then best = {path = item:match('^(.*)%.'), mass = mass} end
        end
        return best
    end,
    check = function(_, answer)
        if not answer then return 'there is no answer' end
        if answer.path ~= '/Store/Box5' or math.abs(answer.mass - 9) > 1e-6 then return answer.path .. ': ' .. answer.mass end
    end,
}
