-- topic: what ends with a script
-- as: sandbox
-- passes: 0
-- spec: sensors 5
-- note: collections and drawing objects end with the script that created them, persistent drawing objects do not
sim = require 'sim'
local function attempt(f, ...)
    local ok, e = pcall(f, ...)
    print(ok or e:match('in sim[%w_%-]*%.[%w_]+: (.*)$') or e)
end
local text = [[
sim = require 'sim'
function sysCall_init()
    local collection = sim.createCollection(0)
    sim.addItemToCollection(collection, sim.handle_all, -1, 0)
    local drawing = sim.addDrawingObject(sim.drawing_points, 1, 0, -1, 10, {1, 0, 0})
    local lasting = sim.addDrawingObject(sim.drawing_points | sim.drawing_persistent, 1, 0, -1, 10, {1, 0, 0})
    sim.setTableProperty(sim.handle_app, 'signal.created', {collection, drawing, lasting})
end
]]
local script = sim.createScript(sim.scripttype_customization, text)
sim.initScript(script)
local collection, drawing, lasting = table.unpack(sim.getTableProperty(sim.handle_app, 'signal.created'))
local own = sim.createCollection(0)
attempt(sim.addItemToCollection, collection, sim.handle_all, -1, 0)
attempt(sim.addDrawingObjectItem, drawing, {0, 0, 0})
sim.removeObjects{script}
attempt(sim.addItemToCollection, collection, sim.handle_all, -1, 0)
attempt(sim.addDrawingObjectItem, drawing, {0, 0, 0})
attempt(sim.addDrawingObjectItem, lasting, {0, 0, 0})
attempt(sim.addItemToCollection, own, sim.handle_all, -1, 0)

local parent = sim.createDummy(0.1)
local moving = sim.addDrawingObject(sim.drawing_lines, 1, 0, parent, 10, {1, 0, 0})
local many = sim.addDrawingObject(sim.drawing_points, 1, 0, -1, 3, {1, 0, 0})
print(sim.addDrawingObjectItem(many | sim.handleflag_addmultiple, {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}))
print(sim.addDrawingObjectItem(many, {4, 0, 0}))
print(sim.addDrawingObjectItem(many, nil), sim.addDrawingObjectItem(many, sim.packFloatTable{5, 0, 0}))
attempt(sim.addDrawingObjectItem, moving, {0, 0, 0, 1, 0, 0})
sim.removeObjects{parent}
attempt(sim.addDrawingObjectItem, moving, {0, 0, 0, 1, 0, 0})
attempt(sim.addDrawingObject, sim.drawing_points, 1, 0, parent, 10, {1, 0, 0})
