--[[
The core of LuaSocket: objects for TCP, UDP and local sockets, select, time, names.

Use `socket`, which adds to this.
]]

local _, native = ...

local core = {
    _VERSION = 'LuaSocket 3.0.0', _SETSIZE = 1024, _SOCKETINVALID = -1, _DATAGRAMSIZE = 8192,
    tcp = native.tcp, tcp4 = native.tcp4, tcp6 = native.tcp6, udp = native.udp, udp4 = native.udp4, udp6 = native.udp6,
    gettime = native.gettime, sleep = native.sleep, dns = {},
}

---------------------------------------------------------------- classes

-- Native methods are named by the group they belong to.
local function group(name, methods)
    methods = methods or {}
    for key, method in pairs(native) do
        local of, as = key:match('^(%a+):(%a+)$')
        if of == name then methods[as] = method end
    end
    return methods
end

local function show(object) return ('%s: %p'):format(native.class_name(object), object) end

local function define(number, methods)
    native.define(number, {__index = methods, __gc = native.collect, __tostring = show, __name = 'socket'})
end

local stream = group('stream', group('any'))
stream.setpeername, stream.setsockname = stream.connect, stream.bind
local datagram = group('datagram', group('any'))
datagram.setpeername, datagram.setsockname = datagram.connect, datagram.bind
datagram.getoption, datagram.setoption = native['any:getoption'], native['any:setoption']

-- Each class has methods of its own, since scripts add to them.
local function copy(methods, without)
    local copied = {}
    for name, method in pairs(methods) do copied[name] = method end
    for _, name in ipairs(without) do copied[name] = nil end
    return copied
end

local TCP <const>, UNIX_STREAM <const>, UDP <const>, UNIX_DATAGRAM <const> = 1, 2, 4, 5
define(TCP, copy(stream, {}))
define(UNIX_STREAM, copy(stream, {'getfamily'}))
define(UDP, copy(datagram, {'bind', 'connect'}))
define(UNIX_DATAGRAM, copy(datagram, {'getfamily'}))

group('dns', core.dns)

---------------------------------------------------------------- connecting

local MAKERS <const> = {inet = core.tcp4, inet6 = core.tcp6, unspec = core.tcp}

-- A connected object. The own address may be given.
-- @api table object, string error = socket.core.connect(string host, any port, string ownHost = nil, any ownPort = nil, string family = nil)
function core.connect(host, port, ownHost, ownPort, family)
    local make = MAKERS[family or 'unspec']
    if not make then
        error(("bad argument #5 to 'connect' (invalid option '%s')"):format(tostring(family)), 2)
    end
    local object, message = make()
    if not object then return nil, message end
    local ok = true
    if ownHost then ok, message = object:bind(ownHost, ownPort or '0') end
    if ok then ok, message = object:connect(host, port) end
    if ok then return object end
    object:close()
    return nil, message
end

---------------------------------------------------------------- select

-- Descriptors of the open objects of a list, and their objects.
local function descriptors(list, argument)
    local numbers, objects = {}, {}
    if list == nil then return numbers, objects end
    if type(list) ~= 'table' then
        error(("bad argument #%d to 'select' (table expected, got %s)"):format(argument, type(list)), 3)
    end
    for _, object in ipairs(list) do
        local number = object:getfd()
        if number and number >= 0 then
            numbers[#numbers + 1] = number
            objects[#objects + 1] = object
        end
    end
    return numbers, objects
end

-- Objects that are ready, as a list and by object.
local function ready(objects, flags, dirty)
    local found, count = {}, 0
    for i, object in ipairs(objects) do
        if flags[i] or dirty and dirty[i] then
            count = count + 1
            found[count] = object
            found[object] = count + 0.0
        end
    end
    return found, count
end

-- @api table readable, table writable, string error = socket.core.select(table readers, table writers, float seconds = nil)
function core.select(readers, writers, seconds)
    local readNumbers, readObjects = descriptors(readers, 1)
    local writeNumbers, writeObjects = descriptors(writers, 2)
    seconds = seconds or -1
    if type(seconds) ~= 'number' then
        error(("bad argument #3 to 'select' (number expected, got %s)"):format(type(seconds)), 2)
    end
    local dirty, anyDirty = {}, false
    for i, object in ipairs(readObjects) do
        dirty[i] = object:dirty()
        anyDirty = anyDirty or dirty[i]
    end
    local readable, writable = native.poll(readNumbers, writeNumbers, anyDirty and 0 or seconds)
    local readReady, readCount = ready(readObjects, readable, dirty)
    local writeReady, writeCount = ready(writeObjects, writable)
    if readCount + writeCount == 0 then return readReady, writeReady, 'timeout' end
    return readReady, writeReady
end

---------------------------------------------------------------- errors as results

local Exception = {}

-- A function that returns its arguments, or raises the second when the first is nothing, after calling `finalizer`.
-- @api func try = socket.core.newtry(func finalizer = nil)
function core.newtry(finalizer)
    return function(...)
        if ... then return ... end
        if finalizer then pcall(finalizer) end
        error(setmetatable({(select(2, ...))}, Exception), 0)
    end
end

local function unprotect(ok, first, ...)
    if ok then return first, ... end
    if getmetatable(first) == Exception then return nil, first[1] end
    error(first, 0)
end

-- A function whose exceptions become results.
-- @api func protected = socket.core.protect(func f)
function core.protect(f)
    return function(...) return unprotect(pcall(f, ...)) end
end

-- @api any rest = socket.core.skip(int count, ...)
function core.skip(count, ...) return select(count + 1, ...) end

function core.__unload() end

return core
