-- topic: interface
-- as: customization
-- passes: 0
-- loops: 3
-- spec: simui 4, sensors 7, sensors 8
-- note: text editors, events of windows in the middle of a callback, values of old graphs, lights
sim = require 'sim'
simUI = require 'simUI'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)

local function count(...) return select('#', ...) end

local function lit(light)
    local state, _, diffuse, specular = sim.getLightParameters(light)
    print('light', state, diffuse, specular)
end

local function made(element)
    local xml = '<CoppeliaSim><filetype>simpleModel</filetype><xmlSerializationNb>2</xmlSerializationNb>' .. element .. '</CoppeliaSim>'
    return sim.loadModel(sim.packUInt8Table{xml:byte(1, -1)})
end

function changed(_, id, value) print('changed', id, value) end

function sysCall_init()
    local ui = simUI.create '<ui title="Test"><hslider id="1" on-change="changed"/></ui>'
    simUI.setSliderValue(ui, 1, 10, false)
    simUI.setSliderValue(ui, 1, 20, false)
    print('not yet')
    print('handled', count(sim.handleExtCalls()))
    sim.handleExtCalls()
    simUI.setSliderValue(ui, 1, 30, false)
    print('the last one waits for the end of the loop')

    local editor = sim.textEditorOpen('first\nsecond', '<editor title="Notes" position="10 20" size="30 40"/>')
    print('visible', select(4, sim.textEditorGetInfo(editor)))
    sim.textEditorShow(editor, false)
    print('visible', select(4, sim.textEditorGetInfo(editor)))
    sim.textEditorShow(editor, true)
    print('visible', select(4, sim.textEditorGetInfo(editor)))
    local text, position, size = sim.textEditorClose(editor)
    print('closed', text == 'first\nsecond', position, size)
    print('gone', (sim.textEditorGetInfo(editor)), (sim.textEditorClose(editor)))

    local graph = made('<graph><common><alias>graph</alias><switches><modelBase>true</modelBase></switches></common></graph>')
    sim.addGraphStream(graph, 'height', 'm', 0, {1, 0, 0})
    sim.addGraphStream(graph, 'speed', 'm/s', 0, {0, 1, 0})
    -- A value counts for the next record only: nothing is recorded at 2.
    for time, value in ipairs{0.5, false, 1.5} do
        if value then sim.setGraphUserData(graph, 'height', value) end
        sim.setGraphUserData(graph, 'speed', -time)
        sim.handleGraph(graph, time)
    end
    for index = 0, 1 do
        local name, _, _, times, values = sim.getGraphCurve(graph, 0, index)
        print('curve', name, times, values)
    end
    print('no stream', (pcall(sim.setGraphUserData, graph, 'width', 1)), (pcall(sim.setGraphUserData, ui, 'height', 1)))

    local light = made('<light><common><alias>light</alias><switches><modelBase>true</modelBase></switches></common><type>spot</type></light>')
    sim.setLightParameters(light, 0, nil, {0.25, 0.5, 0.75}, {1, 0, 0.5})
    lit(light)
    sim.setLightParameters(light, 1)
    lit(light)
    sim.setLightParameters(light, 1, nil, nil, {0, 0.25, 0})
    lit(light)
    print('no light', (pcall(sim.getLightParameters, graph)), (pcall(sim.setLightParameters, graph, 1)))
end
