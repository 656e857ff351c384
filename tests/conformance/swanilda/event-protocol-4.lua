-- topic: events
-- as: sandbox
-- passes: 0
-- loops: 8
-- spec: events 2
-- note: protocol 4 on request: new names, tags, and a snapshot at once
sim = require 'sim'
local a = sim.createDummy(0.01)
sim.createScript(sim.scripttype_customization, string.format([[
sim = require 'sim'
cbor = require 'org.conman.cbor'
A, n = %d, 0
local function hex(text) return (text:gsub('.', function(c) return string.format('%%02x', c:byte()) end)) end
function sysCall_nonSimulation()
    n = n + 1
    if n == 2 then
        print(pcall(sim.setIntProperty, sim.handle_app, 'protocolVersion', 5))
        sim.setIntProperty(sim.handle_app, 'protocolVersion', 4)
    end
    if n == 3 then sim.setObjectAlias(A, 'a') sim.setObjectPosition(A, {1, 2, 3}) end
    if n == 4 then sim.setObjectParent(sim.createDummy(0.02), A, true) end
    if n == 5 then sim.setIntProperty(sim.handle_app, 'protocolVersion', 3) end
end
function sysCall_event(b)
    local bytes = tostring(b)
    if n == 2 then
        local events = cbor.decode(bytes)
        print(events[1].event, events[2].data.protocolVersion, events[#events].event)
    elseif n == 3 then
        local at = bytes:find('\x64pose', 1, true)
        print(hex(bytes:sub(at + 5, at + 5 + 9 + 15)), bytes:find('\x64name\x61a', 1, true) ~= nil)
    elseif n == 4 then
        local at = bytes:find('\x66parent', 1, true)
        print(hex(bytes:sub(at + 7, at + 16)))
        at = bytes:find('\x67objects', 1, true)
        print(hex(bytes:sub(at + 8, at + 17)))
    elseif n == 5 then
        print(cbor.decode(bytes)[2].data.protocolVersion)
    end
end
]], a), 0, 'lua')
