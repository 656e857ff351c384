-- topic: calls
-- as: sandbox
-- loops: 1
-- note: tables are copied whole or not at all
sim = require 'sim'
local function nested(levels)
    local t = {}
    for _ = 2, levels do t = {t} end
    return t
end
local function levels(t) return t[1] and 1 + levels(t[1]) or 1 end
print(levels(sim.unpackTable(sim.packTable(nested(100)))))
print(pcall(sim.packTable, nested(101)))
print(pcall(sim.setTableProperty, sim.handle_scene, 'customData.x', nested(150)))
sim.setTableProperty(sim.handle_scene, 'customData.x', nested(99))
print(levels(sim.getTableProperty(sim.handle_scene, 'customData.x')))
function deep() return nested(500) end
print(pcall(sim.callScriptFunction, 'deep', sim.handle_self))
