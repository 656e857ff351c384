-- topic: events
-- as: sandbox
-- passes: 0
-- loops: 6
-- spec: events 5
-- note: a hook receives events without a callback of that name; a listener that ends is forgotten
sim = require 'sim'
local d = sim.createDummy(0.01)
sim.createScript(sim.scripttype_customization, string.format([[
sim = require 'sim'
cbor = require 'org.conman.cbor'
D, n = %d, 0
function onEvents(b)
    for _, e in ipairs(cbor.decode(tostring(b))) do
        if e.handle == D and e.event == 'objectChanged' then print(n, e.data.layer) end
    end
end
function sysCall_init() sim.registerScriptFuncHook('sysCall_event', 'onEvents', false) end
function sysCall_nonSimulation()
    n = n + 1
    sim.setIntProperty(D, 'layer', n)
    sim.setIntProperty(D, 'layer', n)
    if n == 4 then return {cmd = 'cleanup'} end
end
]], d), 0, 'lua')
