--[[
CoppeliaSim's visualization stream, for its web front end: the events of protocol 3, over WebSocket.

Loaded as an add-on. Who connects is sent a snapshot, then each batch of events as one binary message; what clients say is ignored. With
a folder of the front end's files (of your own CoppeliaSim), the same port serves them to browsers.

Parameters (sim.setNamedStringParam, -D): visualizationStream.ws.port, visualizationStream.ws.enable, and visualizationStream.resources, the
folder of the files.
]]

local _, native = ...
local sim = require('sim')
local simWS = require('simWS')

local EXTENSIONS <const> = {html = true, htm = true, css = true, js = true, map = true}

local server
local clients = {} -- in the order they came
local port = sim.getNamedStringParam('visualizationStream.ws.port') or '23020'
local folder = sim.getNamedStringParam('visualizationStream.resources')

---------------------------------------------------------------- stream

local function remove(connection)
    for i = #clients, 1, -1 do
        if clients[i] == connection then table.remove(clients, i) end
    end
end

-- A client that is too slow for its own memory is left behind: its socket ends.
local function send(connection, batch)
    local sent = pcall(simWS.send, server, connection, batch, simWS.opcode.binary)
    if not sent then remove(connection) end
end

local function onOpen(_, connection)
    -- The snapshot first delivers what is pending, to those who are here already.
    local snapshot = sim.getGenesisEvents()
    clients[#clients + 1] = connection
    send(connection, snapshot)
end

local function onClose(_, connection) remove(connection) end

function sysCall_event(batch)
    for _, connection in ipairs({table.unpack(clients)}) do send(connection, batch) end
end

---------------------------------------------------------------- files

local function unescaped(path)
    return (path:gsub('%%(%x%x)', function(digits) return string.char(tonumber('0x' .. digits)) end))
end

-- Name below the folder of what a browser asks for; nothing where it is none of the front end's files.
local function nameOf(resource)
    local path = unescaped(resource:match('^[^?#]*'))
    if path == '' or path == '/' then path = '/index.html' end
    local extension = path:match('%.(%w+)$')
    local isInside = path:sub(1, 1) == '/' and not path:find('..', 1, true) and not path:find('[\\%z:]')
    if isInside and EXTENSIONS[extension] and (extension ~= 'map' or path:find('%.js%.map$')) then
        return path, extension
    end
end

local function onRequest(_, _, resource)
    local name, extension = nameOf(resource)
    local file = folder and name and io.open(folder .. name, 'rb')
    if not file then return 404, '' end
    local content = file:read('a') or ''
    file:close()
    if extension == 'html' then
        content = content:gsub('const wsPort = 23020;', 'const wsPort = ' .. port .. ';')
    end
    return 200, content
end

---------------------------------------------------------------- the add-on

setAutoYield(false)

function sysCall_init()
    server = native.start()
    simWS.setOpenHandler(server, onOpen)
    simWS.setCloseHandler(server, onClose)
    simWS.setHTTPHandler(server, onRequest)
end
