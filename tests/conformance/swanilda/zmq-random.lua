-- topic: simZMQ
-- as: sandbox
-- passes: 0
-- spec: simzmq 4
-- note: random calls, most of them with wrong arguments: each is answered, and the program goes on
sim = require 'sim'
local z = require 'simZMQ'
math.randomseed(1)
local names = {}
for name, f in pairs(z.__noError) do names[#names+1] = name end
table.sort(names)
local handles = {'', 'x', z.ctx_singleton()}
local function pick(t) return t[math.random(#t)] end
local ends = {'inproc://a','inproc://b','tcp://127.0.0.1:*', 'tcp://127.0.0.1:9', 'foo','udp://1','ws://127.0.0.1:*','pgm://x', 'inproc://', 'tcp://', '', 'tcp://[::1]:*', 'tipc://{1,2}', 'vmci://1:2', 'inproc://'..('x'):rep(300)}
local values = {
 function() return pick(handles) end, function() return pick(handles) end, function() return pick(handles) end,function() return pick(handles) end,
 function() return math.random(-2, 100) end, function() return 1 end, function() return 1 end, function() return pick(ends) end,
 function() return pick{math.mininteger, math.maxinteger, 2^31, -1, 0/0, 1/0, 1.5, 1<<31} end,
 function() return sim.packInt32Table{math.random(-1, 300)} end, function() return {pick(handles), pick(handles)} end, function() return {1, 2} end,
 function() return nil end, function() return ('y'):rep(math.random(0, 300)) end,
 function() return sim.packInt32Table{math.random(-1,2), math.random(-1,1)} end,
}
local block = {send=3, recv=2, msg_send=3, msg_recv=3}
for i = 1, 10000 do
    local name = pick(names)
    if name ~= 'socket_monitor' and name ~= 'proxy' and name ~= 'proxy_steerable' then
    local args = {}
    local n = math.random(0, 4)
    for k = 1, n do args[k] = pick(values)() end
    if math.random() < 0.7 then
       -- plausible
       if name == 'socket' then args = {pick(handles), math.random(0, 12)} n=2
       elseif name == 'setsockopt' then args = {pick(handles), math.random(1, 115), pick(values)()} n=3
       elseif name == 'getsockopt' then args = {pick(handles), math.random(1, 115), pick{4,8,256,0,-1}} n=3
       elseif name == 'bind' or name=='connect' or name=='unbind' or name=='disconnect' then args = {pick(handles), pick(ends)} n=2
       elseif name == 'ctx_set' then args = {pick(handles), math.random(1,12), math.random(-1, 40)} n=3
       elseif name == 'socket_monitor' then args = {pick(handles), pick(ends), math.random(0,65535)} n = 3
       elseif block[name] then args = {pick(handles), pick(handles), 1 | math.random(0,3)} n = 3 if name=='recv' then args[2]=1 end end
    end
    if block[name] then args[block[name]] = 1 | math.random(0, 3) n = math.max(n, block[name]) if name == 'recv' then n = 2 end end
    if name == 'poll' then args[3] = 0 n = 3 end
    if name == 'ctx_term' and math.random() < 0.9 then n = 0 end
    if name ~= 'ctx_new' or math.random() < 0.02 then
    local r = table.pack(pcall(z.__noError[name], table.unpack(args, 1, n)))
    if r[1] and type(r[2]) == 'string' and r[2]:find ':zmq' and #handles < 200 then handles[#handles+1] = r[2] end
    end
    end
    if #handles >= 190 then for k = 4, 60 do pcall(z.close, handles[k]) pcall(z.msg_destroy, handles[k]) end table.move(handles, 61, #handles, 4) for k = #handles, #handles - 56, -1 do handles[k] = nil end end
end
print('done')
