-- topic: events
-- as: sandbox
-- passes: 0
-- loops: 8
-- spec: events 3
-- note: what renaming, re-parenting and selecting tells about others
sim = require 'sim'
local a, b, c = sim.createDummy(0.01), sim.createDummy(0.01), sim.createDummy(0.01)
local w = sim.createScript(sim.scripttype_customization, string.format([[
sim = require 'sim'
cbor = require 'org.conman.cbor'
A, B, C, n = %d, %d, %d, 0
NAMES = {[A] = 'A', [B] = 'B', [C] = 'C', [sim.handle_scene] = 'scene', [sim.handle_app] = 'app'}
function sysCall_nonSimulation()
    n = n + 1
    if n == 2 then sim.setObjectParent(C, B, true) end
    if n == 3 then sim.setObjectSel({A, C}) end
    if n == 4 then sim.setObjectSel({C}) sim.removeObjects({A}) end
    if n == 5 then sim.setObjectAlias(B, 'b') sim.setObjectAlias(B, 'dummy') end
end
function sysCall_event(b)
    if n < 2 then return end
    for _, e in ipairs(cbor.decode(tostring(b))) do
        local keys = {}
        for k, v in pairs(e.data) do
            if k ~= 'time' then keys[#keys + 1] = k .. '=' .. (type(v) == 'table' and #v or tostring(v)) end
        end
        table.sort(keys)
        print(n, e.event, NAMES[e.handle], table.concat(keys, " "))
    end
end
]], a, b, c), 0, 'lua')
sim.setObjectAlias(w, 'w')
