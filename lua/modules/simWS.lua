--[[
WebSocket servers and clients.

    start(port)                      a server, by its handle; it answers plain HTTP at the same port
    getPort(server)                  its port; start(0) selects any free port (not in CoppeliaSim)
    stop(server)                     closes all its connections at once
    connect('ws://host:port/path')   a client, by its handle; its open or fail handler will be called
    disconnect(client)
    send(endpoint, connection, data, opcode)
                                     opcode.text (default), opcode.binary or opcode.continuation; an error when the
                                     connection is gone, text is no UTF-8, or 64 000 000 bytes are queued for the peer
    setOpenHandler(endpoint, f), setFailHandler, setCloseHandler
                                     f(endpoint, connection)
    setMessageHandler(endpoint, f)   f(endpoint, connection, data); data is a buffer
    setHTTPHandler(server, f)        f(server, connection, resource, data) returns status and data; the content type follows the name of the
                                     resource

A handler is a function, or the name of a global one of the script that called start or connect. Handlers are called once per loop iteration, before
the step. While a script is busy, an endpoint queues 4096 events and 64 000 000 bytes; then senders wait. Messages and HTTP requests are limited
to 32 000 000 bytes. A server has up to 1000 connections; it listens on 127.0.0.1 unless the program runs with --bind. Endpoints are closed with the
script that created them.

Named parameters: simWS.verbose (1: connections are logged), simWS.userAgent (of clients).
]]

local _, simWS = ...
local sim = require('sim')

local AGENT <const> = 'simWS.userAgent'
if not sim.getNamedStringParam(AGENT) then
    local version = sim.getIntProperty(sim.handle_app, 'productVersionNb')
    local a, b, c, d = version // 1000000, version // 10000 % 100, version // 100 % 100, version % 100
    local platforms = {[0] = 'Windows', 'macOS', 'Linux'}
    local platform = platforms[sim.getInt32Param(sim.intparam_platform)] or 'Unknown-platform'
    sim.setNamedStringParam(AGENT, ('CoppeliaSim/%d.%d.%drev%d %s'):format(a, b, c, d, platform))
end

return simWS
