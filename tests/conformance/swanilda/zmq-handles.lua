-- topic: simZMQ
-- as: sandbox
-- passes: 0
-- spec: simzmq 1, simzmq 4, simzmq 8
-- note: arguments and handles that are none; objects used after their end
sim = require 'sim'
local z = require 'simZMQ'
local function try(f, ...)
    local ok, message = pcall(f, ...)
    print(ok, (tostring(message):gsub('^.-in simZMQ', 'in simZMQ'):gsub('^%[string.-: ', '')))
end
local c = z.ctx_new()
local s, q, m = z.socket(c, z.PAIR), z.socket(c, z.PAIR), z.msg_new()

try(z.bind)
try(z.bind, s)
try(z.bind, s, 'x', 3)
try(z.bind, s, 5)
try(z.bind, {}, 'x')
try(z.socket, c, '3')
try(z.socket, c, 0 / 0)
try(z.socket, c, math.huge)
try(z.poll, s, {1})
try(z.poll, {s, false}, {1, 1})
try(z.recv, s)
try(z.__recv, s)
try(z.recv, s, 1, 'x')
print(z.socket(c, 2.95):match('^%x+:') ~= '0:', z.socket(tobuffer(c), 2) ~= '0:zmq.socket')

for _, handle in ipairs{'', ':', 'x', '0:zmq.socket', '1:zmq.socket', c, m, s .. ' ', s:upper(), '-' .. s, 'fffffffffffffffffffff:zmq.socket'} do
    local ok, message = pcall(z.close, handle)
    if ok or not message:find 'invalid object handle' then print('accepted', handle) end
end
for _, name in ipairs{'ctx_get', 'msg_size', 'close', 'msg_close', 'msg_destroy', 'msg_data', 'ctx_term', 'ctx_shutdown'} do
    local ok, message = pcall(z[name], 'nobody', name == 'ctx_get' and 1 or nil)
    if ok then print('accepted', name) end
end

print(z.bind(s, 'inproc://a'), z.connect(q, 'inproc://a'))
print(z.bind(s, 'inproc://a\0b'), z.errnum() == z.EINVAL)
print(z.close(s))
try(z.send, s, 'x', 0)
try(z.recv, s, 0)
try(z.poll, {q, s}, {1, 1}, 0)
try(z.proxy, q, q, s)
try(z.close, s)

-- messages that are not open
print(z.msg_size(m), #z.msg_data(m), z.msg_more(m))
print(z.msg_close(m), z.errnum() == z.EFAULT, z.msg_recv(m, q, z.DONTWAIT), z.msg_send(m, q, z.DONTWAIT), z.msg_get(m, z.MORE))
for _, size in ipairs{-1, 1 << 40, math.mininteger, math.maxinteger} do print(z.msg_init_size(m, size), z.errnum() == z.ENOMEM) end
print(z.msg_init_size(m, 3), tostring(z.msg_data(m)) == '\0\0\0', z.msg_set(m, z.MORE, 1), z.errnum() == z.EINVAL)
print(z.msg_gets(m, 'Socket-Type'))
local n = z.msg_new()
print(z.msg_copy(n, m), z.msg_init(n), z.msg_copy(n, m), z.msg_size(n), z.msg_move(n, n), z.msg_size(n), z.msg_move(m, n), z.msg_size(n))
print(z.msg_close(m), z.msg_close(m))
print(z.msg_destroy(m))
try(z.msg_size, m)

-- sizes
local big = z.socket(c, z.PAIR)
for _, length in ipairs{-1, 0, 1 << 40, math.maxinteger} do print(z.getsockopt(big, z.LINGER, length)) end
q = z.socket(c, z.PAIR)
print(z.bind(big, 'inproc://big'), z.connect(q, 'inproc://big'))
z.send(big, 'abc', 0)
print(#select(2, z.recv(q, 0, -1)))
z.send(big, 'abc', 0)
print(#select(2, z.recv(q, 0, math.maxinteger)))

-- what would end the program in libzmq
print(z.ctx_set(c, z.IO_THREADS, 1 << 20), z.ctx_set(c, z.MAX_SOCKETS, 1 << 30), z.ctx_set(c, z.THREAD_SCHED_POLICY, 7))
print(z.setsockopt(big, z.USE_FD, sim.packInt32Table{0}))
local router = z.socket(c, z.ROUTER)
print(z.setsockopt(router, z.CONNECT_ROUTING_ID, 'a'), z.setsockopt(router, z.CONNECT_ROUTING_ID, 'a'), z.setsockopt(router, z.CONNECT_ROUTING_ID, '\0'))
print(z.socket(c, 13), z.socket(c, -1))

-- the end of a context
print(z.ctx_term(c), z.errnum() == z.EINTR)
print(z.recv(q, 0), z.errnum() == z.ETERM)
print(z.socket(c, z.PAIR), z.errnum() == z.ETERM)
try(z.ctx_term, z.ctx_singleton())
try(z.ctx_shutdown, z.ctx_singleton())
local e = z.ctx_new()
local p = z.socket(e, z.PUSH)
print(z.ctx_shutdown(e), z.send(p, 'x', 0), z.errnum() == z.ETERM, z.close(p), z.ctx_term(e))
try(z.ctx_term, e)
local contexts = 0
while pcall(z.ctx_new) do contexts = contexts + 1 end
print(contexts > 10, contexts < 1000)
