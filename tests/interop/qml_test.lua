--[[ Interfaces in QML in tests: items by their `objectName`, events both ways, windows that come and go. ]]

local sim = require 'sim'
local t = require 'swanilda.test'

local DIALS <const> = [[
import QtQuick
import QtQuick.Controls
import CoppeliaSimPlugin 1.0
PluginWindow {
    id: dials
    title: "Dials"; width: 320; height: 300
    function turn(data) { speed.value = data.to; return 1 }
    function more() { second.show() }
    Connections { target: simBridge; function onEventReceived(name, data) { if (name == "other") simBridge.sendEvent("got", data.list[1]) } }
    Column {
        Button { objectName: "ok"; text: "Press"; onClicked: simBridge.sendEvent("pressed", {n: ++names.presses}) }
        Slider { id: speed; objectName: "speed"; to: 10; onMoved: simBridge.sendEvent("slid", value) }
        Label { objectName: "shown"; text: speed.value.toFixed(1) }
        TextField { objectName: "name"; onAccepted: names.append({name: text}) }
        ComboBox { objectName: "kind"; model: ["slow", "fast"]; onActivated: (place) => simBridge.sendEventRaw("kind", place) }
        CheckBox { objectName: "check"; text: "Check"; onToggled: simBridge.sendEvent("checked", checked) }
        Button { objectName: "off"; enabled: false; text: "Off" }
        ListView { objectName: "names"; width: 100; height: 60; model: ListModel { id: names; property int presses: 0 } delegate: Text { objectName: "row" + index; text: name } }
    }
    ApplicationWindow { id: second; title: "Second"; width: 100; height: 50; Button { objectName: "hide"; onClicked: second.close() } }
}]]

local CODE <const> = [[
simQML = require 'simQML'
engine = simQML.createEngine()
function received(_, name, data) print(name, type(data) == 'table' and data.n or data) end
simQML.setEventHandler(engine, 'received')
simQML.loadData(engine, %q)
function send(name, data) simQML.sendEvent(engine, name, data) end
function sysCall_init() end
]]

local function printed(text)
    for _, line in ipairs(t.prints()) do if line == text then return true end end
    return false
end

describe('an interface in QML', function()
    local script, w

    before_each(function()
        sim.setStringProperty(sim.handle_app, 'namedParam.python', os.getenv('QML_PYTHON') or 'python3')
        script = sim.createScript(sim.scripttype_customization, CODE:format(DIALS))
        sim.initScript(script)
        w = t.ui('Dials')
    end)

    it('has items by their names', function()
        w:click('ok')
        assert.is_true(printed('pressed, 1'))
        w:click('Press')
        assert.is_true(printed('pressed, 2'))
        w:set('speed', 7)
        assert.is_true(printed('slid, 7'))
        assert.are.equal('7.0', w:value('shown'))
        w:set('kind', 'fast')
        assert.is_true(printed('kind, 1'))
        assert.are.equal('fast', w:value('kind'))
        w:set('check', true)
        assert.is_true(printed('checked, true'))
        assert.is_true(w:value('check'))
    end)

    it('takes texts into a list', function()
        assert.are.equal(0, w:value('names'))
        w:enter('name', 'one')
        w:enter('name', 'two')
        assert.are.equal(2, w:value('names'))
        assert.are.equal('two', w:value('row1'))
        w:key('name', 0x42, 'B')
        assert.are.equal('twoB', w:value('name'))
    end)

    it('knows what scripts have sent', function()
        sim.callScriptFunction('send', script, 'turn', {to = 3})
        assert.are.equal(3, w:value('speed'))
        sim.callScriptFunction('send', script, 'other', {list = {1, 'b'}})
        assert.are.equal('3.0', w:value('shown'))
        t.step()
        assert.is_true(printed('got, b'))
    end)

    it('refuses what a person cannot do', function()
        assert.error_matches(function() w:click('none') end, "window 'Dials' has no item 'none'; it has: .*Button 'ok', .*Slider 'speed'")
        assert.error_matches(function() w:click('off') end, "item 'off' is disabled")
        assert.error_matches(function() w:set('kind', 'none') end, "there is no such choice: it is one of %['slow', 'fast'%]")
        assert.error_matches(function() w:link('ok', 'a') end, "an item of QML takes no 'link'")
        assert.is_false(w:is_enabled('off'))
    end)

    it('has windows that come and go', function()
        sim.callScriptFunction('send', script, 'more', {})
        local second = t.ui('Second')
        assert.is_true(second:is_open())
        second:click('hide')
        assert.is_false(second:is_open())
        w:close()
        assert.is_false(w:is_open())
        assert.error_matches(function() w:click('ok') end, "window 'Dials' is not visible")
    end)

    it('ends with its script', function()
        sim.removeObjects({script})
        assert.error_matches(function() t.ui('Dials') end, 'there is no window')
    end)
end)
