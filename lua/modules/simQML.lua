--[[
User interfaces in QML. Where there is a Python with PySide6 (`pip install swanilda[qml]`; `-D python=PATH` names another one), an interface runs in a process
of its own, which draws into memory and ends with the simulator; its windows are on the page like those of simUI. Otherwise, and where programs must not be
started, a window of simUI shows the source and why it is not drawn, lists the events that the script sends, and a person can send events to the script from it.

Events have a name and data, which are JSON between a script and its interface. In QML, `simBridge.sendEvent(name, data)` sends one to the script. One of the
script calls the function of that name at the root of the interface with the data, and emits `simBridge.eventReceived(name, data)`. `sendEventRaw` and
`eventReceivedRaw` have the JSON as a text.

What is wrong with an interface when it is loaded is an error of the script, with file, line and column; what goes wrong later is logged, as is `console.log`.
]]

local _, simQML = ...

local simUI = require 'simUI'
local json = require 'dkjson'

local start, stop, send, version = simQML.start, simQML.stop, simQML.send, simQML.version
simQML.start, simQML.stop, simQML.send, simQML.version = nil, nil, nil, nil

local engines, count, byWindow = {}, 0, {}

local SOURCE <const>, SENT <const>, NAME <const>, DATA <const> = 2, 3, 4, 5
local NOTICE <const> = 'QML is not drawn here. %s This is its source. Events that it would send can be sent below.'
local MAX_EVENTS <const> = 100 -- that are shown

-- The numbers are ours.
simQML.image_data_format = {gray8 = 0, rgb888 = 1, bgr888 = 2, rgbx8888 = 3, rgb32 = 4, argb32 = 5}

local function engineOf(handle) return engines[handle] or error('invalid object handle', 3) end

---------------------------------------------------------------- engines

--- Makes an engine, which can load one interface.
-- @api string handle = simQML.createEngine()
-- @return handle
function simQML.createEngine()
    count = count + 1
    local handle = ('%x:QQmlApplicationEngine'):format(count)
    engines[handle] = {handle = handle, sent = {}}
    return handle
end

local function close(engine)
    if engine.number then stop(engine.number) end
    engine.number = nil
    if not engine.window then return end
    byWindow[engine.window] = nil
    simUI.destroy(engine.window)
    engine.window = nil
end

--- Ends an engine and closes its windows.
-- @api simQML.destroyEngine(string handle)
-- @param handle the engine
function simQML.destroyEngine(handle)
    close(engineOf(handle))
    engines[handle] = nil
end

---------------------------------------------------------------- the source in a window

local function escaped(text) return (text:gsub('[&<>"]', {['&'] = '&amp;', ['<'] = '&lt;', ['>'] = '&gt;', ['"'] = '&quot;'})) end

-- A person sends an event to the script.
local function raised(ui)
    local engine = byWindow[ui]
    local name, data = simUI.getEditValue(ui, NAME), simUI.getEditValue(ui, DATA)
    if not engine or name == '' then return end
    if engine.handler then engine.handler(engine.handle, name, data) end
end

local function showSource(engine, source, reason)
    _S.simQML = {raised = raised}
    local title = source:match 'title:%s*"([^"]*)"' or 'QML'
    local text = ([[<ui title="%s" closeable="true" resizable="true" size="500,400">
        <label text="%s" word-wrap="true"/>
        <text-browser id="%d" type="plain" text=""/>
        <text-browser id="%d" type="plain" text=""/>
        <group layout="form" flat="true">
            <label text="Event:"/><edit id="%d" value=""/>
            <label text="Data (JSON):"/><edit id="%d" value="{}"/>
        </group>
        <button text="Send to the script" on-click="_S.simQML.raised"/>
    </ui>]]):format(escaped(title), escaped(NOTICE:format(reason)), SOURCE, SENT, NAME, DATA)
    engine.window = simUI.create(text)
    byWindow[engine.window] = engine
    simUI.setText(engine.window, SOURCE, source)
    addLog(430, 'simQML: QML is not drawn here; a window shows its source. ' .. reason) -- 430: sim.verbosity_scriptwarnings
end

---------------------------------------------------------------- loading

local function show(engine, source, name)
    close(engine)
    local function received(_, event, text)
        if engine.handler then engine.handler(engine.handle, event, tostring(text)) end
    end
    local number, lacking, wrong = start(engine.handle, source, name, received)
    if wrong then error(wrong, 3) end
    if lacking then return showSource(engine, source, lacking) end
    engine.number = number
end

local function folderOfScene()
    local sim = require 'sim'
    return (sim.getStringProperty(sim.handle_scene, 'scenePath', {noError = true}) or ''):match '^(.*)[/\\]'
end

--- Loads an interface from a file.
-- @api simQML.load(string engineHandle, string filename)
-- @param engineHandle the engine
-- @param filename a file with QML; without a folder that is its own, in that of the scene
function simQML.load(engineHandle, filename)
    local engine = engineOf(engineHandle)
    local folder = folderOfScene()
    local file, message = io.open(filename, 'rb')
    if not file and folder then
        filename = folder .. '/' .. filename
        file = io.open(filename, 'rb')
    end
    if not file then error(message, 2) end
    local source = file:read 'a'
    file:close()
    if not filename:find '[/\\]' then filename = './' .. filename end
    show(engine, source, filename)
end

--- Loads an interface from a text.
-- @api simQML.loadData(string engineHandle, string data, string basepath = '')
-- @param engineHandle the engine
-- @param data QML
-- @param basepath the folder of the files that the text names; else that of the scene
function simQML.loadData(engineHandle, data, basepath)
    local engine = engineOf(engineHandle)
    local folder = basepath and basepath ~= '' and basepath or folderOfScene()
    show(engine, tostring(data), folder and folder .. '/data.qml' or 'data.qml')
end

---------------------------------------------------------------- events

--- Sends an event to an interface.
-- @api simQML.sendEventRaw(string engineHandle, string eventName, string eventData)
-- @param engineHandle the engine
-- @param eventName name
-- @param eventData JSON
function simQML.sendEventRaw(engineHandle, eventName, eventData)
    local engine = engineOf(engineHandle)
    if engine.number then return send(engine.number, eventName, tostring(eventData)) end
    local sent = engine.sent
    if #sent == MAX_EVENTS then table.remove(sent, 1) end
    sent[#sent + 1] = eventName .. ' ' .. tostring(eventData)
    if engine.window then simUI.setText(engine.window, SENT, table.concat(sent, '\n')) end
end

--- Sends an event to an interface.
-- @api simQML.sendEvent(string engine, string name, table data)
-- @param engine the engine
-- @param name name
-- @param data any value that JSON has
function simQML.sendEvent(engine, name, data)
    local ok, text = pcall(json.encode, data)
    if not ok then error('the data of an event must be what JSON has', 2) end
    simQML.sendEventRaw(engine, name, text)
end

local function functionNamed(name)
    local f = _G
    for part in tostring(name):gmatch '[^.]+' do f = type(f) == 'table' and f[part] or nil end
    return f
end

local function handle(engineHandle, name, decode)
    engineOf(engineHandle).handler = function(engine, event, text)
        local f = type(name) == 'function' and name or functionNamed(name)
        if f then f(engine, event, decode(text)) end
    end
end

--- Names the function that receives the events of an interface, with engine, name and JSON.
-- @api simQML.setEventHandlerRaw(string engineHandle, string functionName)
-- @param engineHandle the engine
-- @param functionName a global function of the script
function simQML.setEventHandlerRaw(engineHandle, functionName) handle(engineHandle, functionName, tobuffer) end

local function decoded(text)
    local data, _, reason = json.decode(text)
    if reason then error('the data of the event is no JSON: ' .. reason, 0) end
    return data
end

--- Names the function that receives the events of an interface, with engine, name and data.
-- @api simQML.setEventHandler(string engine, string funcName)
-- @param engine the engine
-- @param funcName a global function of the script
function simQML.setEventHandler(engine, funcName) handle(engine, funcName, decoded) end

---------------------------------------------------------------- pictures, version

-- Bytes of a pixel, what makes them what sim.saveImage wants, and its options.
local LAYOUTS <const> = {
    [0] = {1, '.', '%0', 2}, [1] = {3, '.', '%0', 0}, [2] = {3, '(.)(.)(.)', '%3%2%1', 0}, [3] = {4, '(...).', '%1', 0},
    [4] = {4, '(.)(.)(.).', '%3%2%1', 0}, [5] = {4, '(.)(.)(.)(.)', '%3%2%1%4', 1},
}

--- An image as a text that QML takes as the source of an Image.
-- @api string dataURL = simQML.imageDataURL(buffer data, int width, int height, string format = 'BMP', int data_format = simQML.image_data_format.rgb888)
-- @param data rows of pixels, the first on top
-- @param width pixels
-- @param height pixels
-- @param format BMP, PNG or JPG
-- @param data_format one of simQML.image_data_format
-- @return dataURL
function simQML.imageDataURL(data, width, height, format, data_format)
    local layout = LAYOUTS[data_format or simQML.image_data_format.rgb888]
    if not layout then error('invalid data format', 2) end
    local bytes, kind = tostring(data), (format or 'BMP'):lower()
    local isImage = math.type(width) == 'integer' and math.type(height) == 'integer' and width > 0 and height > 0
    if not isImage or #bytes ~= width * height * layout[1] then error('invalid image size', 2) end
    local pixels = bytes:gsub(layout[2], layout[3])
    local sim = require 'sim'
    local image = sim.saveImage(pixels, {width, height}, layout[4], '.' .. kind, -1)
    local encoded = sim.transformBuffer(image, sim.buffer_uint8, 1, 0, sim.buffer_base64)
    return ('data:image/%s;base64,'):format(kind == 'jpg' and 'jpeg' or kind) .. tostring(encoded)
end

--- The version of Qt that draws interfaces.
-- @api int[] version = simQML.qtVersion()
-- @return version three numbers; zeros where QML is not drawn
function simQML.qtVersion() return version() end

return simQML
