-- An error in one of many scripts.
return {
    task = 'A script raises an error when the simulation runs. Find it, and repair it: the counter of /Plant shall rise by 1 in each step.',
    scene = [==[
sim = require 'sim'

function sysCall_init()
    for i = 1, 6 do
        local script = sim.createScript(sim.scripttype_simulation, 'sim = require "sim"\nfunction sysCall_actuation() n = (n or 0) + 1 end')
        sim.setObjectAlias(script, 'Worker' .. i)
    end
    local plant = sim.createDummy(0.1)
    sim.setObjectAlias(plant, 'Plant')
    local script = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'

function sysCall_init()
    plant = sim.getObject('..')
    sim.setIntProperty(plant, 'customData.count', 0)
end

function sysCall_actuation()
    local count = sim.getIntProperty(plant, 'customData.cuont')
    sim.setIntProperty(plant, 'customData.count', count + 1)
end
]])
    sim.setObjectAlias(script, 'Counter')
    sim.setObjectParent(script, plant, false)
end
]==],
    solve = function(call)
        local run = call('run_until', {time = 1})
        assert(run.values.reason:find('error of a script'), run.text)
        local path, line = run.text:match('(/[%w/]+):(%d+)\n')
        local source = call('read_script', {script = path, from = tonumber(line), to = tonumber(line)}).text
        assert(source:find('cuont'), source)
        call('simulation', {action = 'stop'})
        call('write_script', {script = path, old = 'customData.cuont', new = 'customData.count'})
    end,
    check = function(call)
        local run = call('step', {count = 10}).values
        if run.reason ~= 'Done' then return run.reason end
        local count = call('get_properties', {items = {'/Plant.customData.count'}}).values.values['/Plant.customData.count']
        if not count or count < 9 then return 'the counter is ' .. tostring(count) end
    end,
}
