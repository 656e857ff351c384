-- topic: modules
-- as: customization
-- passes: 0
-- loops: 5
-- spec: libraries 4; without a Python simQML shows the source of an interface, sends and receives events, encodes images
sim = require 'sim'
local simQML, simUI = require 'simQML', require 'simUI'

function received(engine, name, data) print('received', engine == handle, name, data.x, data.list) end

function receivedRaw(engine, name, data) print('raw', name, isbuffer(data), tostring(data)) end

local windows = {}
local create = simUI.create
simUI.create = function(...)
    windows[#windows + 1] = create(...)
    return windows[#windows]
end

sim.setStringProperty(sim.handle_app, 'namedParam.python', '/nowhere/python3')
print('no Qt', simQML.qtVersion())
handle = simQML.createEngine()
simQML.setEventHandler(handle, 'received')
simQML.loadData(handle, 'import QtQuick 2.7\nWindow { title: "Arm & leg"\n width: 200 }')
local ui = windows[1]
print(simUI.getTitle(ui))
simQML.sendEvent(handle, 'move', {1, 2, text = nil})
simQML.sendEvent(handle, 'stop', {now = true})
simUI.setEditValue(ui, 4, 'pressed')
simUI.setEditValue(ui, 5, '{"x": 3, "list": [1, 2]}')
_S.simQML.raised(ui)
simQML.setEventHandlerRaw(handle, 'receivedRaw')
_S.simQML.raised(ui)
print(pcall(simQML.sendEvent, handle, 'bad', print))
print(pcall(simQML.load, handle, '/nowhere/at/all.qml'))
print(pcall(simQML.sendEventRaw, 'nothing', 'a', 'b'))
local url = simQML.imageDataURL(string.char(255, 0, 0, 0, 255, 0), 2, 1)
print(url)
print(pcall(simQML.imageDataURL, 'abc', 2, 2))
simQML.destroyEngine(handle)
print(pcall(simQML.destroyEngine, handle))
print(pcall(simUI.getTitle, ui))

function sysCall_nonSimulation() sim.quitSimulator() end
