--[[
Sockets that are paths of this machine.

    stream(), dgram()       new objects; tcp and udp are other names of these

Methods are those of TCP and UDP objects with a path in place of host and port.
]]

local _, native = ...
require('socket.core') -- defines the classes

local unix = {stream = native.unix_stream, dgram = native.unix_dgram, tcp = native.unix_stream, udp = native.unix_dgram}

-- @api table object, string error = socket.unix.stream()
-- @api table object, string error = socket.unix.dgram()

return setmetatable(unix, {__call = function() return native.unix_stream() end})
