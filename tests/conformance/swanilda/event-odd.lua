-- topic: events
-- as: sandbox
-- passes: 0
-- loops: 8
-- spec: events 6
-- note: odd arguments, and listeners that change things, fail or go away while they listen
sim = require 'sim'
local d = sim.createDummy(0.01)
sim.setObjectAlias(d, 'd')
local function mk(alias, code)
    local h = sim.createScript(sim.scripttype_customization, code, 0, 'lua')
    sim.setObjectAlias(h, alias)
end
mk('odd', string.format([[
sim = require 'sim'
cbor = require 'org.conman.cbor'
D, n = %d, 0
local function try(f, ...) print(select(2, pcall(f, ...))) end
function sysCall_nonSimulation()
    n = n + 1
    if n == 2 then
        local cycle = {}
        cycle.cycle = cycle
        try(sim.setEventFilters, 'all')
        try(sim.setEventFilters, {[{}] = {}, [1.5] = {'a'}, x = 3})
        try(sim.pushUserEvent, 'e', 1)
        try(sim.pushUserEvent, 'e', 1, 1, 5)
        print((pcall(sim.pushUserEvent, 'e', 1, 1, cycle)))
        sim.pushUserEvent('list', -1, -1, {1, 2, 3})
        sim.pushUserEvent('', 0, 0, {})
    end
    if n == 4 then sim.setEventFilters({[-99] = {}, [D] = {'no such property'}}) sim.setIntProperty(D, 'layer', 7) end
    if n == 5 then sim.setEventFilters({[D] = {'layer', 'layer', 5}}) sim.setIntProperty(D, 'layer', 6) end
end
function sysCall_event(b)
    if n < 2 then return end
    for _, e in ipairs(cbor.decode(tostring(b))) do
        if e.event ~= 'logMsg' and e.event ~= 'msgDispatchTime' and e.event ~= 'objectChanged' then print(n, e.event, e.data) end
        if n > 3 then print(n, e.event, e.data.layer) end
    end
end
]], d))
mk('changes', string.format([[
sim = require 'sim'
n = 0
function sysCall_event(b)
    n = n + 1
    sim.setIntProperty(%d, 'customData.count', n)
    if n == 3 then sim.setEventFilters({[sim.handle_app] = {}}) end
end
]], d))
mk('fails', "function sysCall_event(b) error('no') end")
mk('goes', "sim = require 'sim' function sysCall_event(b) sim.removeObjects({sim.getObject('.')}, true) end")
