-- A place that follows from sizes.
return {
    task = 'Put the cup /Cup onto the middle of the table /Table. It shall stand there.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    local top = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.8, 0.6, 0.7})
    sim.setObjectAlias(top, 'Table')
    sim.setObjectPosition(top, {1, 0.5, 0.35})
    sim.setBoolProperty(top, 'respondable', true)
    local cup = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.08, 0.08, 0.1})
    sim.setObjectAlias(cup, 'Cup')
    sim.setObjectPosition(cup, {-1, 0, 0.05})
    sim.setBoolProperty(cup, 'dynamic', true)
    sim.setBoolProperty(cup, 'respondable', true)
end
]==],
    solve = function(call)
        local tree = call('scene').text
        local height = tonumber(tree:match('Table #%d+: shape at %b() m, size %([%d.]+, [%d.]+, ([%d.]+)%)'))
        local cup = tonumber(tree:match('Cup #%d+: shape at %b() m, size %([%d.]+, [%d.]+, ([%d.]+)%)'))
        call('set_properties', {values = {['/Cup.position'] = {1, 0.5, height + cup / 2}}})
    end,
    check = function(call)
        call('run_until', {time = 1})
        local touching = call('contacts', {object = '/Cup'}).text
        if not touching:find('/Table', 1, true) then return touching end
        local at = call('get_properties', {items = {'/Cup.position'}}).values.values['/Cup.position']
        if math.abs(at[1] - 1) + math.abs(at[2] - 0.5) > 0.02 then return 'not in the middle' end
    end,
}
