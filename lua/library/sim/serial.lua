--[[
Serial ports, based on native non-blocking ones.

Does not hold the ports: they belong to the simulator. Bytes fetched but not read yet belong to the script that fetched them.
]]

local sim = ...
local M = {}

local unread = {} -- port handle -> bytes fetched but not read

local OPEN_ARGS = {{type = 'string'}, {type = 'int'}}

--- Opens a serial port: 8 data bits, no parity, one stop bit. It is closed when the simulation ends.
-- @api int portHandle = sim.serialOpen(string portString, int baudrate)
-- @param portString path of the device, for instance /dev/ttyUSB0
-- @param baudrate one of the usual rates from 50 to 230400
-- @return portHandle -1 if it cannot be opened
function M.serialOpen(...)
    local path, baudRate = require('checkargs.check')(OPEN_ARGS, ...)
    local handle = sim._serialOpen(path, baudRate)
    if handle > 0 then unread[handle] = '' end
    return handle
end

--- Closes a serial port.
-- @api sim.serialClose(int portHandle)
-- @param portHandle from sim.serialOpen
function M.serialClose(...)
    local handle = require('checkargs.check')({{type = 'int'}}, ...)
    sim._serialClose(handle)
    unread[handle] = nil
end

local function fetch(handle, length)
    local data = unread[handle]
    if #data < length then data = data .. tostring(sim._serialRead(handle, length - #data) or '') end
    unread[handle] = data
    return data
end

local function take(handle, data, length)
    unread[handle] = data:sub(length + 1)
    return data:sub(1, length)
end

local READ_ARGS = {
    {type = 'int'}, {type = 'int'}, {type = 'bool', default = false}, {type = 'string', default = ''},
    {type = 'float', default = 0},
}

--- Reads from a serial port. In a thread, the simulation goes on while it waits.
-- @api string data = sim.serialRead(int portHandle, int dataLengthToRead, bool blockingOperation = false, string closingString = '', float timeout = 0)
-- @param portHandle from a sim.serialOpen of this script
-- @param dataLengthToRead at most so many bytes
-- @param blockingOperation true: waits for all of them
-- @param closingString ends the reading earlier; it is the end of what is returned
-- @param timeout seconds of wall-clock time after which a wait ends with what there is; 0: none
-- @return data empty if there is nothing
function M.serialRead(...)
    local handle, length, blocking, closingString, timeout = require('checkargs.check')(READ_ARGS, ...)
    length, closingString = math.max(length, 0), tostring(closingString)
    if not unread[handle] then error('sim.serialRead: not a port this script has opened', 2) end
    local start = sim.getSystemTime()
    while true do
        local data = fetch(handle, length)
        if not blocking or #data >= length then return take(handle, data, length) end
        local _, last = data:find(closingString, 1, true)
        if last and last > 0 then return take(handle, data, last) end
        if timeout ~= 0 and sim.getSystemTime() - start >= timeout then return take(handle, data, length) end
        sim.step()
        sim._serialRest()
        if not unread[handle] then error('sim.serialRead: the port was closed', 2) end
    end
end

return M
