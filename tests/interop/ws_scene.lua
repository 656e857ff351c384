-- Endpoints for tests, made by the code that comes to a server of its own.
sim = require 'sim'
simWS = require 'simWS'

passes = 0
calls = {} -- what handlers got

function note(name)
    return function(endpoint, connection, data)
        calls[#calls + 1] = table.concat({name, endpoint, connection, data and tostring(data) or nil}, ' ')
    end
end

function echo(endpoint, connection, data) simWS.send(endpoint, connection, data) end

function echoBinary(endpoint, connection, data) simWS.send(endpoint, connection, data, simWS.opcode.binary) end

local function perform(control, connection, code)
    local f, reason = load(tostring(code))
    local ok, result = false, reason
    if f then ok, result = pcall(f) end
    simWS.send(control, connection, (ok and '' or 'error: ') .. tostring(result))
end

function sysCall_init()
    local control = simWS.start(0)
    simWS.setMessageHandler(control, perform)
    print('control ' .. simWS.getPort(control))
end

function sysCall_nonSimulation() passes = passes + 1 end
