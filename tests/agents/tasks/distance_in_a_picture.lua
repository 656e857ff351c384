-- What a camera sees: distances in a picture.
return {
    task = 'How far from the vision sensor /Camera is the nearest of the boxes that it sees, and which one is it?',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local camera = sim.createVisionSensor(1 + 2, {128, 128, 0, 0}, {0.05, 10, math.rad(40), 0.1, 0, 0, 0, 0, 0, 0, 0})
    sim.setObjectAlias(camera, 'Camera')
    sim.setObjectPosition(camera, {0, 0, 0.5})
    sim.setObjectOrientation(camera, {0, math.pi / 2, 0})
    for name, place in pairs {Near = {-1, 0, 0.5}, Middle = {2, 0.3, 0.5}, Far = {4, -0.5, 0.5}} do
        local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.2})
        sim.setObjectAlias(box, name)
        sim.setObjectPosition(box, place)
    end
end
]==],
    solve = function(call)
        local nearest
        for _, label in ipairs(call('picture', {camera = '/Camera'}).values.labels) do
            if not nearest or label.distance < nearest.distance then nearest = label end
        end
        return nearest
    end,
    check = function(_, answer)
        if not answer then return 'there is no answer' end
        if answer.path ~= '/Middle' or math.abs(answer.distance - 1.9) > 0.02 then return answer.path .. ' at ' .. answer.distance end
    end,
}
