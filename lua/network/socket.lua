--[[
TCP, UDP and names, with the interface of LuaSocket 3.0.

    connect(host, port, ownHost, ownPort, family)   a connected object
    connect4, connect6(host, port, ownHost, ownPort)   the same, for IPv4 or IPv6
    bind(host, port, backlog)               a server object
    tcp(), tcp4(), tcp6(), udp(), udp4(), udp6()                            new objects
    select(readers, writers, seconds)       waits for objects: those ready to be read, those ready to be written, 'timeout'
    dns.toip, dns.tohostname, dns.getaddrinfo, dns.getnameinfo, dns.gethostname
    gettime(), sleep(seconds), skip(n, ...), newtry(f), try(...), protect(f)
    sink(how, object), source(how, object, length), sinkt, sourcet          ends of a pump of ltn12

Objects:
    connect, bind, listen, accept, close, shutdown                          TCP; UDP: setpeername, setsockname
    receive(pattern, prefix), send(data, i, j)                              TCP
    receive(size), receivefrom(size), send(data), sendto(data, ip, port)    UDP
    settimeout(seconds, mode), gettimeout, setoption, getoption, getsockname, getpeername, getfamily
    getstats, setstats, dirty, getfd, setfd

Calls block the script, and with it the simulation, unless there is a time-out: settimeout(0) or select. Failures are results: nil,
the reason, and for receive and send what was done before.
]]

local socket = require('socket.core')

socket.BLOCKSIZE = 2048
socket.sinkt, socket.sourcet = {}, {}
-- @api any results = socket.try(...)
socket.try = socket.newtry()

-- @api table object, string error = socket.connect4(string host, any port, string ownHost = nil, any ownPort = nil)
function socket.connect4(host, port, ownHost, ownPort) return socket.connect(host, port, ownHost, ownPort, 'inet') end
-- @api table object, string error = socket.connect6(string host, any port, string ownHost = nil, any ownPort = nil)
function socket.connect6(host, port, ownHost, ownPort) return socket.connect(host, port, ownHost, ownPort, 'inet6') end

local function listening(make, address, port, backlog)
    local server, message = make()
    if not server then return nil, message end
    server:setoption('reuseaddr', true)
    local ok
    ok, message = server:bind(address, port)
    if ok then ok, message = server:listen(backlog) end
    if ok then return server end
    server:close()
    return nil, message
end

-- A server at the first address of the host that is free.
-- @api table server, string error = socket.bind(string host, any port, int backlog = 32)
function socket.bind(host, port, backlog)
    if host == '*' then host = '0.0.0.0' end
    local addresses, message = socket.dns.getaddrinfo(host)
    if not addresses then return nil, message end
    local server
    message = 'no info on address'
    for _, address in ipairs(addresses) do
        local make = address.family == 'inet6' and socket.tcp6 or socket.tcp4
        server, message = listening(make, address.addr, port, backlog)
        if server then return server end
    end
    return nil, message
end

-- A function that picks an entry of a table by the name it gets first.
-- @api func choice = socket.choose(table makers)
function socket.choose(makers)
    return function(name, first, second)
        if type(name) ~= 'string' then name, first, second = 'default', name, first end
        local make = makers[name or 'nil']
        if not make then error(('unknown key (%s)'):format(tostring(name)), 3) end
        return make(first, second)
    end
end

-- Sources and sinks look like sockets to `select`.
local function like(object, call)
    local methods = {
        getfd = function() return object:getfd() end,
        dirty = function() return object:dirty() end,
    }
    return setmetatable(methods, {__call = call})
end

socket.sinkt['close-when-done'] = function(object)
    return like(object, function(_, chunk, message)
        if chunk then return object:send(chunk) end
        object:close()
        return message == nil and 1 or nil, message
    end)
end

socket.sinkt['keep-open'] = function(object)
    return like(object, function(_, chunk, message)
        if chunk then return object:send(chunk) end
        return message == nil and 1 or nil, message
    end)
end

socket.sinkt.default = socket.sinkt['keep-open']
socket.sink = socket.choose(socket.sinkt)

socket.sourcet['by-length'] = function(object, length)
    return like(object, function()
        if length <= 0 then return nil end
        local chunk, message = object:receive(math.min(socket.BLOCKSIZE, length))
        if not chunk then return nil, message end
        length = length - #chunk
        return chunk
    end)
end

socket.sourcet['until-closed'] = function(object)
    local done
    return like(object, function()
        if done then return nil end
        local chunk, message, partial = object:receive(socket.BLOCKSIZE)
        if chunk then return chunk end
        if message ~= 'closed' then return nil, message end
        object:close()
        done = true
        if partial ~= '' then return partial end
    end)
end

socket.sourcet.default = socket.sourcet['until-closed']
socket.source = socket.choose(socket.sourcet)

-- @api table object, string error = socket.connect(string host, any port, string ownHost = nil, any ownPort = nil, string family = nil)
-- @api table object, string error = socket.tcp()
-- @api table object, string error = socket.tcp4()
-- @api table object, string error = socket.tcp6()
-- @api table object, string error = socket.udp()
-- @api table object, string error = socket.udp4()
-- @api table object, string error = socket.udp6()
-- @api table readable, table writable, string error = socket.select(table readers, table writers, float seconds = nil)
-- @api float seconds = socket.gettime()
-- @api socket.sleep(float seconds)
-- @api any rest = socket.skip(int n, ...)
-- @api func try = socket.newtry(func f = nil)
-- @api func protected = socket.protect(func f)

return socket
