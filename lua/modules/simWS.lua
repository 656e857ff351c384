--[[
A handler is a function, or the name of a global one of the script that called start or connect. Handlers are called once per loop iteration, before
the step. While a script is busy, an endpoint queues 4096 events and 64 000 000 bytes; then senders wait. Messages and HTTP requests are limited
to 32 000 000 bytes. A server has up to 1000 connections; it listens on 127.0.0.1 unless the program runs with --bind, and answers plain HTTP at the
same port. Endpoints are closed with the script that created them.

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
