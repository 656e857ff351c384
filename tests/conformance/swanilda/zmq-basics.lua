-- topic: simZMQ
-- as: sandbox
-- passes: 0
-- spec: simzmq 1, simzmq 4, simzmq 7, simzmq 8
-- note: handles, errors as results and as errors, options, parts of messages, poll
sim = require 'sim'
local z = require 'simZMQ'
local c = z.ctx_new()
print(c:match('^%x+:zmq.context$') ~= nil, z.socket(c, z.REP):match('^%x+:zmq.socket$') ~= nil)
local s = z.socket(c, z.REQ)
local r, d = z.__noError.recv(s, z.DONTWAIT)
print(r, d, z.errnum() == z.EFSM, z.strerror(z.errnum()))
print(z.strerror(z.EAGAIN), z.strerror(z.ETERM))
print(z.send(s, 'x', z.DONTWAIT), z.errnum() == z.EAGAIN)
print(z.bind(s, 'foo'), z.errnum() == z.EINVAL, z.bind(s, 'xyz://a'), z.errnum() == z.EPROTONOSUPPORT)
print(z.unbind(s, 'tcp://127.0.0.1:1'), z.errnum() == z.ENOENT, z.disconnect(s, 'tcp://127.0.0.1:1'), z.errnum() == z.ENOENT)
local pub, sub = z.socket(c, z.PUB), z.socket(c, z.SUB)
print(z.recv(pub, z.DONTWAIT), z.errnum() == z.ENOTSUP)
print(z.send(sub, 'x', z.DONTWAIT), z.errnum() == z.ENOTSUP)

-- errors instead of results
local first, second = z.socket(c, z.REP), z.socket(c, z.REP)
print(z.bind(first, 'tcp://127.0.0.1:*'))
local _, endpoint = z.getsockopt(first, z.LAST_ENDPOINT, 256)
endpoint = tostring(endpoint):gsub('%z', '')
z.__raiseErrors(true)
print(pcall(function() z.bind(second, endpoint) end))
print(z.__noError.bind(second, endpoint), pcall(z.__raiseError.bind, second, endpoint))
print(pcall(function() return z.recv(second, z.DONTWAIT) end))
z.__raiseErrors()
print(z.bind(second, endpoint), z.errnum() == z.EADDRINUSE)

-- options are bytes
print(z.setsockopt(s, z.LINGER, sim.packInt32Table{0}), z.setsockopt(s, z.LINGER, 'x'), z.errnum() == z.EINVAL)
local result, value = z.getsockopt(s, z.LINGER, 4)
print(result, sim.unpackInt32Table(value)[1], z.getsockopt_int(s, z.LINGER))
result, value = z.getsockopt(s, z.TYPE, 2)
print(result, #value, z.errnum() == z.EINVAL)
print(z.setsockopt(s, z.AFFINITY, sim.packInt32Table{1, 0}), z.setsockopt(s, 4711, sim.packInt32Table{1}), z.errnum() == z.EINVAL)
print(z.setsockopt(s, z.ROUTING_ID, 'me'), (select(2, z.getsockopt(s, z.ROUTING_ID, 255))))
for _, option in ipairs{z.LINGER, z.SNDHWM, z.RCVHWM, z.RCVTIMEO, z.SNDTIMEO, z.RECONNECT_IVL, z.BACKLOG} do
    print(z.getsockopt_int(pub, option))
end
print(('=i8'):unpack(tostring(select(2, z.getsockopt(pub, z.MAXMSGSIZE, 8)))))
print(z.setsockopt(s, z.CURVE_SERVER, sim.packInt32Table{1}) == (z.has('curve') == 1 and 0 or -1))

-- messages
local a, b = z.socket(c, z.PAIR), z.socket(c, z.PAIR)
print(z.connect(b, 'inproc://later'), z.bind(a, 'inproc://later'))
print(z.send(a, 'hello', 0))
result, value = z.recv(b, 0, 3)
print(result, type(value), value)
print(z.send(a, tobuffer('\0\1'), z.SNDMORE), z.send(a, '', 0))
for _ = 1, 2 do
    result, value = z.recv(b, 0)
    print(result, #value, z.getsockopt_int(b, z.RCVMORE))
end
local m = z.msg_new()
print(m:match('^%x+:zmq.msg$') ~= nil, z.msg_init(m))
z.send(a, 'a', z.SNDMORE)
z.send(a, 'b', 0)
for _ = 1, 2 do print(z.msg_recv(m, b, 0), z.msg_more(m), z.msg_get(m, z.MORE), z.msg_data(m), z.msg_size(m)) end
print(z.recv(b, z.DONTWAIT), z.errnum() == z.EAGAIN)

-- poll
local count, ready = z.poll({b}, {z.POLLIN}, 0)
print(count, ready[1])
z.send(a, 'x', 0)
count, ready = z.poll({b, a, b}, {z.POLLIN, z.POLLIN, z.POLLIN | z.POLLOUT}, 1000)
print(count, ready[1], ready[2], ready[3])
print(pcall(function() z.poll({b}, {}, 0) end))
print(z.poll({}, {}, -1))
print(z.poll({a}, {z.POLLIN}))

print(z.socket(c, 99), z.errnum() == z.EINVAL)
print(pcall(function() return z.ctx_term(z.ctx_singleton()) end))
print(z.ctx_get(c, z.IO_THREADS), z.ctx_set(c, z.IO_THREADS, 2), z.ctx_get(c, z.IO_THREADS), z.ctx_get(c, 4711))
print(z.version())
print(z.has('ipc'), z.has('draft'), z.has('nonsense'))
print(z.z85_encode('\x86\x4f\xd2\x6f\xb5\x59\xf7\x5b'), #z.z85_decode('HelloWorld'), z.z85_encode('abc'), z.z85_decode('ab'))
print(z.REQ, z.EVENT_ALL, z.PROTOCOL_ERROR_ZAP_INVALID_METADATA, z.NOBLOCK, z.IDENTITY, z.EFSM - z.HAUSNUMERO, z.SERVER)
