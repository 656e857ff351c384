-- topic: simZMQ
-- as: sandbox
-- passes: 0
-- spec: simzmq 3
-- note: a wait outside of threads ends: nothing can hold a run for ever
sim = require 'sim'
local z = require 'simZMQ'
z.__timeout = 0.02
local pull = z.socket(z.ctx_new(), z.PULL)
z.bind(pull, 'tcp://127.0.0.1:*')
print(z.__timeout, z.recv(pull, 0))
print(z.errnum() == z.EAGAIN, z.__recv(pull, 0))
print(z.poll({pull}, {z.POLLIN}, -1))
print(z.proxy(pull, pull, pull))
z.__raiseErrors(true)
print(tostring(select(2, pcall(z.recv, pull, 0))):match '%a[%a ]+$')
z.__timeout = math.huge
print(z.poll({pull}, {z.POLLIN}, 1))
