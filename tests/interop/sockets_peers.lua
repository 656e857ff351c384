-- Talks to the peers of sockets_peers.py.
local socket = require 'socket'
local unix = require 'socket.unix'
local lfs = require 'lfs'
local checks = require 'sockets_checks'

local is, descriptors = checks.is, checks.descriptors
local function param(name) return sim.getNamedStringParam(name) end
local function are(what, expected, ...)
    local found = table.pack(...)
    for i = 1, found.n do found[i] = tostring(found[i]) end
    is(table.concat(found, ' '), expected, what)
end
local before = descriptors()
local function connect(name)
    local c = assert(socket.connect('127.0.0.1', param(name)))
    c:settimeout(10)
    return c
end

local function everything()

---------------------------------------------------------------- streams

local c = connect('echo')
is(c:send('one\ntwo'), 7, 'send')
are('line', 'one nil nil', c:receive())
are('count', 'two nil nil', c:receive(3))
local large = ('0123456789'):rep(300000)
-- Both directions are full before all is sent.
c:settimeout(0)
local sent, parts = 0, {}
local length = 0
while length < #large do
    local r, w = socket.select({c}, sent < #large and {c} or nil, 10)
    if w[c] then
        local last, message, partial = c:send(large, sent + 1)
        sent = last or partial
        assert(last or message == 'timeout', message)
    end
    if r[c] then
        local data, message, partial = c:receive('*a')
        assert(data or message == 'timeout', message)
        parts[#parts + 1] = data or partial
        length = length + #parts[#parts]
    end
end
is(table.concat(parts) == large, true, 'echo of 3 MB')
c:close()

c = connect('slow')
are('a slow line', 'slow line nil nil', c:receive())
are('a slow end', 'rest nil nil', c:receive('*a'))
are('after the end', 'nil closed ', c:receive('*a'))
c:close()
c = connect('slow')
c:settimeout(0.03, 't')
local data, message, partial = c:receive('*a')
are('a limit for the whole', 'nil timeout true', data, message, #partial < 14)
c:close()
c = connect('silent')
c:settimeout(0.01)
are('silence', 'nil timeout ', c:receive())
are('silence with a prefix', 'nil timeout pre', c:receive('*l', 'pre'))
c:close()
c = connect('gone')
are('gone', 'nil closed ', c:receive())
c:close()
are('closed here', 'nil closed ', c:receive())
are('closed here', 'nil closed 0.0', c:send('x'))
c = connect('gone')
c:receive()
repeat data, message, partial = c:send('x') until not data
are('sending to nobody', 'nil closed', data, message)
c:close()
c = connect('reset')
c:send('x')
is(c:receive(4), 'part', 'before the reset')
are('reset', 'nil closed ', c:receive())
c:close()
c = connect('lines')
for i = 0, 99999 do is(c:receive(), 'line ' .. i, 'lines') end
are('after the lines', 'nil closed ', c:receive())
c:close()
c = connect('huge')
is(#c:receive(), 20000000, 'a huge line')
is(c:receive(), 'end', 'the line after it')
c:close()

are('nobody', 'nil connection refused', socket.connect('127.0.0.1', param('closed')))
are('unknown host', 'nil host or service not provided, or not known', socket.connect('nosuch.invalid', 80))
are('unknown service', 'nil service not supported for socket type', socket.connect('127.0.0.1', '99999'))
are('a port in use', 'nil address already in use', socket.bind('127.0.0.1', param('echo')))
is(select(2, socket.connect('127.0.0.1', param('echo'), '127.0.0.1', '0')), nil, 'with an address of its own')

-- Connecting without waiting.
c = socket.tcp4()
c:settimeout(0)
local ok
ok, message = c:connect('127.0.0.1', param('echo'))
is(ok or message, ok and 1.0 or 'timeout', 'connect without waiting')
are('writable', '1', #select(2, socket.select(nil, {c}, 10)))
is(select(2, c:connect('127.0.0.1', param('echo'))) ~= 'timeout', true, 'connected')
is(c:getpeername(), '127.0.0.1', 'peer')
is(c:send('x\n'), 2, 'send after connecting')
c:settimeout(10)
is(c:receive(), 'x', 'echo after connecting')
is(c:shutdown('send'), 1.0, 'shutdown')
are('after shutdown', 'nil closed ', c:receive())
c:close()

-- Server and clients in one script.
local server = socket.bind('*', 0)
local _, port = server:getsockname()
local clients, accepted = {}, {}
for i = 1, 20 do
    clients[i] = assert(socket.connect('localhost', port))
    accepted[i] = server:accept()
end
for i = 1, 20, 3 do clients[i]:send(i .. '\n') end
socket.sleep(0.05)
local ready = socket.select(accepted, nil, 10)
is(#ready, 7, 'ready')
for i = 1, 20, 3 do
    is(ready[accepted[i]] ~= nil, true, 'ready by object')
    accepted[i]:receive(1)
end
is(#socket.select(accepted, nil, 0), 7, 'what is buffered is readable')
-- Objects of others.
local wrapped = {getfd = function() return accepted[1]:getfd() end, dirty = function() return false end}
clients[1]:send('more')
is(socket.select({wrapped}, nil, 10)[1], wrapped, 'an object with getfd and dirty')
is(pcall(socket.select, {{getfd = function() return 9999 end, dirty = function() end}}, nil, 0), false, 'a foreign descriptor')
-- A socket moves from one object to another.
local other = socket.tcp()
other:setfd(clients[2]:getfd())
clients[2]:setfd(-1)
is(clients[2]:getfd(), -1.0, 'moved away')
is(select(2, pcall(other.send, other, 'x')):match('tcp{client} expected') ~= nil, true, 'still a master')
is(other:getpeername(), '127.0.0.1', 'moved')
other:close()
for i = 1, 20 do
    clients[i]:close()
    accepted[i]:close()
end
server:close()

---------------------------------------------------------------- datagrams

local u = socket.udp()
u:settimeout(10)
is(u:sendto('hello', '127.0.0.1', param('udp')), 5, 'sendto')
are('receivefrom', 'HELLO 127.0.0.1 ' .. param('udp'), u:receivefrom())
is(u:setpeername('127.0.0.1', param('udp')), 1.0, 'setpeername')
is(u:send(('x'):rep(9000)), 9000, 'send')
is(#u:receive(), 8192, 'the usual size')
u:send(('x'):rep(9000))
is(#u:receive(10000), 9000, 'another size')
u:send('')
is(u:receive(), '', 'empty')
are('too long', 'nil Message too long', u:send(('x'):rep(70000)))
is(u:setpeername('*'), 1.0, 'everybody')
are('a name', 'nil host or service not provided, or not known', u:sendto('x', 'localhost', 1))
u:setpeername('127.0.0.1', param('closed'))
u:send('x')
are('nobody', 'nil connection refused', u:receive())
u:close()
are('closed', 'nil closed', u:receive())
is(socket.udp():receive(), nil, 'never opened')
u = socket.udp4()
u:setsockname('*', 0)
is(u:setoption('broadcast', true) and u:getoption('broadcast'), true, 'broadcast')
is(u:setoption('ip-multicast-ttl', 3) and u:getoption('ip-multicast-ttl'), 3.0, 'ttl')
u:close()

---------------------------------------------------------------- options, times, names

c = connect('echo')
for _, name in ipairs{'keepalive', 'tcp-nodelay', 'reuseaddr'} do
    is(c:setoption(name, true), 1.0, name)
    is(c:getoption(name), true, name)
end
is(c:setoption('linger', {on = true, timeout = 3}), 1.0, 'linger')
is(c:getoption('linger').timeout, 3.0, 'linger')
is(c:setoption('tcp-keepidle', 60) and c:getoption('tcp-keepidle'), 60.0, 'keepidle')
is(c:getoption('error'), nil, 'error')
is(pcall(c.setoption, c, 'keepalive', 'yes'), false, 'a wrong value')
is(pcall(c.setoption, c, 'tcp-fastopen', 1), false, 'an option that is not built')
is(c:setstats(10, 20, 30), 1.0, 'setstats')
local received, written, age = c:getstats()
are('getstats', '10.0 20.0 true', received, written, age >= 30)
is(c:settimeout(1) and c:settimeout(2, 't'), 1.0, 'settimeout')
are('gettimeout', '1.0 2.0', c:gettimeout())
is(pcall(c.settimeout, c, 1, 'x'), false, 'mode')
for _, odd in ipairs{0 / 0, -1 / 0} do is(pcall(c.receive, c, odd), false, 'an odd count') end
c:settimeout(0)
are('an endless count', 'nil timeout ', c:receive(1 / 0))
are('nothing to send', '0.0 nil nil', c:send(''))
are('an odd range', '3.0 nil nil', c:send('abc', -1 / 0, 1 / 0))
c:close()
is(socket.dns.toip('localhost'), '127.0.0.1', 'toip')
is(socket.dns.tohostname('127.0.0.1') ~= nil, true, 'tohostname')
is(type(socket.dns.gethostname()), 'string', 'gethostname')
is(#socket.dns.getaddrinfo('localhost') > 0, true, 'getaddrinfo')
are('an unknown name', 'nil host not found', socket.dns.toip('nosuch.invalid'))
local began = socket.gettime()
are('select as a clock', '0 0 timeout', #socket.select(nil, nil, 0.02), 0, 'timeout')
is(socket.gettime() - began >= 0.015, true, 'select waits')

---------------------------------------------------------------- IPv6, where there is any

local six = socket.tcp6()
if six and six:bind('::1', 0) then
    is(six:listen(), 1.0, 'listen')
    local ip, number, family = six:getsockname()
    are('inet6', '::1 inet6 inet6', ip, family, six:getfamily())
    local near = assert(socket.connect6('::1', number))
    is(six:accept() ~= nil, true, 'accept')
    near:close()
end

---------------------------------------------------------------- local sockets

local s = unix()
is(tostring(s):match('^unixstream{master}: 0x%x+$') ~= nil, true, 'tostring')
is(s:connect(param('stream')), 1.0, 'connect')
s:settimeout(10)
s:send('local\n')
is(s:receive(), 'local', 'echo')
s:close()
are('no path', 'nil No such file or directory', unix.stream():connect(param('folder') .. '/none'))
s = unix.stream()
is(s:bind(param('folder') .. '/mine'), 1.0, 'bind')
is(s:listen(), 1.0, 'listen')
is(s:getsockname(), param('folder') .. '/mine', 'getsockname')
local near = unix.stream()
near:connect(param('folder') .. '/mine')
local far = s:accept()
near:send('hi\n')
is(far:receive(), 'hi', 'both ends')
near:close()
far:close()
s:close()
local d = unix.dgram()
d:settimeout(10)
d:bind(param('folder') .. '/datagrams')
is(d:sendto('hi', param('datagram')), 2.0, 'sendto')
are('receivefrom', 'HI ' .. param('datagram'), d:receivefrom())
d:close()
is(pcall(unix.stream().connect, unix.stream(), ('x'):rep(1000)), true, 'a path that is too long')

-- What nobody closed is closed when nobody refers to it.
for _ = 1, 50 do
    local lost = socket.udp4()
    lost:setsockname('127.0.0.1', 0)
end
end

everything()
is(descriptors(), before, 'descriptors')
