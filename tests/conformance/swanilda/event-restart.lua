-- topic: events
-- as: sandbox
-- passes: 4
-- spec: events 6
-- note: filters vanish with the state; objects made in a run and the poses of the start are told when it ends
sim = require 'sim'
local d = sim.createDummy(0.01)
sim.setObjectAlias(d, 'd')
sim.createScript(sim.scripttype_customization, string.format([[
sim = require 'sim'
cbor = require 'org.conman.cbor'
D = %d
function sysCall_init() sim.setEventFilters({[D] = {'pose'}, [sim.handle_sceneobject] = {'alias'}}) end
function sysCall_actuation() sim.setObjectPosition(D, {sim.getSimulationTime(), 0, 0}) if not new then new = sim.createDummy(0.01) sim.setObjectAlias(new, 'new') end end
function sysCall_afterSimulation() told = 0 end
function sysCall_event(b)
    for _, e in ipairs(cbor.decode(tostring(b))) do
        if e.handle == D then print(e.event, string.format('%%.2f', e.data.pose[1]))
        elseif e.handle == new then print(e.event, e.data.alias) end
    end
end
]], d), 0, 'lua')
