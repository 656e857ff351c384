--[[
WebSocket servers and clients.

    start(port)                      a server, by its handle; it answers plain HTTP at the same port
    getPort(server)                  where it listens; start(0) takes any free port (not in CoppeliaSim)
    stop(server)                     its connections end at once
    connect('ws://host:port/path')   a client, by its handle; its handler for open or for fail will be called
    disconnect(client)
    send(endpoint, connection, data, opcode)
                                     opcode.text (as it is without opcode), opcode.binary or opcode.continuation; an error when the
                                     connection is gone, text is no UTF-8, or 64 000 000 bytes wait for the peer already
    setOpenHandler(endpoint, f), setFailHandler, setCloseHandler
                                     f(endpoint, connection)
    setMessageHandler(endpoint, f)   f(endpoint, connection, data); data is a buffer
    setHTTPHandler(server, f)        f(server, connection, resource, data) returns status and data; the content type follows the name of the
                                     resource

A handler is a function, or the name of a global one of the script that called start or connect. Handlers are called once per loop iteration, before
the step. A script that is busy lets senders wait: an endpoint keeps 4096 events and 64 000 000 bytes. Messages and HTTP requests have up
to 32 000 000 bytes. A server has up to 1000 connections; it listens at 127.0.0.1 unless the program runs with --bind. Endpoints go with the
script that made them.

Named parameters: simWS.verbose (1: connections are logged), simWS.userAgent (of clients).
]]

local _, native = ...
local sim = require('sim')

local simWS = {opcode = {continuation = 0, text = 1, binary = 2}}
for name, f in pairs(native) do simWS[name] = f end

local AGENT <const> = 'simWS.userAgent'
if not sim.getNamedStringParam(AGENT) then
    local version = sim.getIntProperty(sim.handle_app, 'productVersionNb')
    local a, b, c, d = version // 1000000, version // 10000 % 100, version // 100 % 100, version % 100
    local platforms = {[0] = 'Windows', 'macOS', 'Linux'}
    local platform = platforms[sim.getInt32Param(sim.intparam_platform)] or 'Unknown-platform'
    sim.setNamedStringParam(AGENT, ('CoppeliaSim/%d.%d.%drev%d %s'):format(a, b, c, d, platform))
end

return simWS
