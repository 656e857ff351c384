-- topic: modules
-- as: customization
-- passes: 0
-- loops: 10
-- spec: models 2, 3; the dialogs of a path, of a control point and of a graph
sim = require 'sim'

local function children(object, type)
    local found, i = {}, 0
    while true do
        local child = sim.getObjectChild(object, i)
        if child < 0 then return found end
        if sim.getObjectType(child) == type then found[#found + 1] = child end
        i = i + 1
    end
end

function sysCall_init()
    local model = sim.createPath({0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 1}, 0, 50, 1)
    local script = children(model, sim.sceneobject_script)[1]
    sim.initScript(script)
    sim.executeScriptString([[
        local simUI = require 'simUI'
        sysCall_userConfig()
        local ui = path.dialog
        print(simUI.getTitle(ui), simUI.getSpinboxValue(ui, 5), simUI.getCheckboxValue(ui, 3))
        path.dialog_changed(ui, 5, 3)
        path.dialog_changed(ui, 6, 0.01)
        path.dialog_changed(ui, 3, 2)
        local info = path.readInfo()
        print(info.pointCnt, info.smoothing, info.bitCoded, simUI.getSpinboxValue(ui, 5), #path.paths[2] // 7)
        local dialog = require 'swanilda.paths.dialog'
        dialog.openPoint(path, path.getCtrlPts()[2])
        path.pointDialog_changed(path.pointDialog, 1, 0.5)
        path.pointDialog_changed(path.pointDialog, 3, 7)
        print(table.unpack(path.paths[3], 6, 10))
        path.dialog_closed(ui)
        print(path.dialog, path.pointDialog ~= nil)
        path.cleanup()
    ]], script)
    local xml = [[<CoppeliaSim><filetype>simpleModel</filetype><xmlSerializationNb>2</xmlSerializationNb>
<graph><common><alias>graph</alias></common></graph></CoppeliaSim>]]
    local graph = sim.loadModel(sim.packUInt8Table({xml:byte(1, -1)}))
    local recorder = sim.createScript(sim.scripttype_customization, "graph = require('graph_customization')")
    sim.setObjectParent(recorder, graph)
    sim.initScript(recorder)
    sim.executeScriptString([[
        local simUI = require 'simUI'
        sysCall_userConfig()
        graph.dialog_changed(graph.dialog, 3, 0)
        graph.dialog_changed(graph.dialog, 7, 2)
        local info = graph.readInfo()
        print(simUI.getTitle(graph.dialog), info.bitCoded, info.graphPos, _S.graph == graph)
    ]], recorder)
end
