-- topic: simZMQ
-- as: sandbox
-- passes: 0
-- spec: simzmq 1, simzmq 8
-- note: the context of all scripts; handles of another script; what a script leaves behind ends with it
sim = require 'sim'
local z = require 'simZMQ'
local shared = z.ctx_singleton()
local a = z.socket(shared, z.PAIR)
print(z.bind(a, 'inproc://between'))

local function script(code)
    local handle = sim.createScript(sim.scripttype_customization, code)
    sim.initScript(handle)
    return handle
end

local other = script([[
sim = require 'sim'
local z = require 'simZMQ'
local b
function context() return z.ctx_singleton() end
function connect() b = z.socket(z.ctx_singleton(), z.PAIR) return z.connect(b, 'inproc://between') end
function receive() return tostring(select(2, z.recv(b, z.DONTWAIT))) end
function use(socket) return pcall(z.close, socket) end
function leave()
    -- To nobody, with the default of waiting for ever for him.
    own = z.ctx_new()
    push = z.socket(own, z.PUSH)
    z.connect(push, 'tcp://127.0.0.1:9')
    for _ = 1, 100 do z.send(push, ('x'):rep(1000), z.DONTWAIT) end
    return z.bind(z.socket(own, z.REP), 'inproc://left')
end
]])
print(sim.callScriptFunction('context', other) == shared)
print(sim.callScriptFunction('connect', other))
print(z.send(a, 'between scripts', z.DONTWAIT), sim.callScriptFunction('receive', other))
print((sim.callScriptFunction('use', other, a)))
print(sim.callScriptFunction('leave', other))
sim.removeObjects{other}
print('the other is gone')
-- Its socket is closed, so that there is nobody to send to.
local tries = 0
while z.send(a, 'x', z.DONTWAIT) == 1 and tries < 1e6 do tries = tries + 1 end
print(z.errnum() == z.EAGAIN)
