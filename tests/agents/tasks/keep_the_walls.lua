-- Objects that are to go, and others that are to stay.
return {
    task = 'Remove all obstacles, and keep the walls.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    for i = 1, 12 do
        local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        sim.setObjectAlias(box, i % 3 == 0 and 'Wall' or 'Obstacle')
        sim.setObjectPosition(box, {i, 0, 0.05})
    end
end
]==],
    solve = function(call)
        call('scene')
        local handles = {}
        for _, object in ipairs(call('find_objects', {pattern = 'obstacle'}).values.objects) do handles[#handles + 1] = object.handle end
        call('run_code', {code = 'sim.removeObjects({' .. table.concat(handles, ', ') .. '})'})
        local changes = call('scene', {changes = true}).text
        assert(select(2, changes:gsub('is gone', '')) == 8, changes)
    end,
    check = function(call)
        local left = call('find_objects', {pattern = 'obstacle'}).values
        if left then return #left.objects .. ' obstacles are there' end
        local walls = call('find_objects', {pattern = 'wall'}).values
        if not walls or #walls.objects ~= 4 then return 'walls are missing' end
    end,
}
