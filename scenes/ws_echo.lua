--[[
A WebSocket server that sends back what it gets.

    swanilda serve scenes/ws_echo.lua --no-remote-api
    swanilda serve scenes/ws_echo.lua --no-remote-api -D port=9000
]]

sim = require 'sim'
simWS = require 'simWS'

function onOpen(server, connection) print('hello ' .. connection) end

function onClose(server, connection) print('bye ' .. connection) end

-- Handlers are not told whether a message was text: what is no UTF-8 goes back as bytes.
function onMessage(server, connection, data)
    local isText = utf8.len(tostring(data)) ~= nil
    simWS.send(server, connection, data, isText and simWS.opcode.text or simWS.opcode.binary)
end

function sysCall_init()
    local server = simWS.start(tonumber(sim.getNamedStringParam('port') or 8080))
    simWS.setOpenHandler(server, 'onOpen')
    simWS.setCloseHandler(server, 'onClose')
    simWS.setMessageHandler(server, 'onMessage')
    print(('ws://127.0.0.1:%d/'):format(simWS.getPort(server)))
end
