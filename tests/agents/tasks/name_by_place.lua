-- Names that follow from places.
return {
    task = 'Three boxes have the same alias. Call them Left, Middle and Right, by their places along y (left is the largest y).',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    for _, y in ipairs {0.1, -0.7, 0.6} do
        local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        sim.setObjectAlias(box, 'Box')
        sim.setObjectPosition(box, {0, y, 0.05})
    end
end
]==],
    solve = function(call)
        local boxes = call('find_objects', {pattern = 'box', type = 'shape'}).values.objects
        table.sort(boxes, function(a, b) return a.position[2] > b.position[2] end)
        local code = ''
        for i, name in ipairs {'Left', 'Middle', 'Right'} do code = code .. string.format("sim.setObjectAlias(%d, '%s')\n", boxes[i].handle, name) end
        call('run_code', {code = code})
    end,
    check = function(call)
        local items = {'/Left.position[2]', '/Middle.position[2]', '/Right.position[2]'}
        local answer = call('get_properties', {items = items})
        local values = answer.values and answer.values.values or {}
        for i, y in ipairs {0.6, 0.1, -0.7} do
            if math.abs((values[items[i]] or 1e9) - y) > 1e-6 then return answer.text end
        end
    end,
}
