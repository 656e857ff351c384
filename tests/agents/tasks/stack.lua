-- A structure that has to stand.
return {
    task = 'Build a tower of five boxes of 10 cm, called Brick1 (at the bottom) to Brick5, which stands for 3 s.',
    solve = function(call)
        local built = call('run_code', {code = [[
for i = 1, 5 do
    local brick = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectAlias(brick, 'Brick' .. i)
    sim.setObjectPosition(brick, {0, 0, 0.1 * i - 0.05})
    sim.setBoolProperty(brick, 'dynamic', true)
    sim.setBoolProperty(brick, 'respondable', true)
end
]]})
        assert(not built.isError, built.text)
    end,
    check = function(call)
        call('run_until', {time = 3})
        local items = {}
        for i = 1, 5 do items[i] = '/Brick' .. i .. '.position[3]' end
        local answer = call('get_properties', {items = items})
        local heights = answer.values and answer.values.values or {}
        for i = 1, 5 do
            if math.abs((heights[items[i]] or 0) - (0.1 * i - 0.05)) > 0.01 then return answer.text end
        end
        if not call('contacts', {object = '/Brick5'}).text:find('/Brick4', 1, true) then return 'it does not stand on the others' end
    end,
}
