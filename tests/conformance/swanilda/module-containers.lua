-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: libraries 1; deque, priorityqueue, itertools
local deque, priorityqueue, itertools = require 'deque', require 'priorityqueue', require 'itertools'
local d = deque{1, 2, 3}
d:pushleft(0)
d:push('z')
d[2] = 'one'
print(#d, d[1], d[2], d[5], d[6], d:popleft(), d:popright(), #d)
for i, x in pairs(d) do print(i, x) end
d = deque()
print(pcall(d.pop, d), pcall(d.popleft, d), #d, pcall(d.push, d, nil), pcall(function() d[1] = 1 end))
for i = 1, 1000 do d:push(i) d:popleft() end
print(#d)
local q = priorityqueue()
for i, p in ipairs{5, 1, 3, 1, 4} do q:push(p, 'v' .. i) end
print(q:size(), q:peek())
print(q:cancel('v3'), q:cancel('v3'))
while not q:isempty() do print(q:pop()) end
print(q:pop(), pcall(q.push, q, 0 / 0, 1))
for x in itertools.chain(('ab'):gmatch('.'), ('c'):gmatch('.')) do print(x) end
for k, x in itertools.chain({'a', 'b'}, {}, {k = 'c'}, ('d'):gmatch('.')) do print(k, x) end
for i, x in itertools.ichain({'a', nil, 'b', k = 'c'}, {'d'}) do print(i, x) end
for _ in itertools.chain() do print('never') end
local next = itertools.chain({1})
print(next(), next(), next())
print(itertools.product{{1, 2}, {'a', 'b'}})
print(itertools.permutations({1, 2, 3}, 2))
print(itertools.combinations({1, 2, 3}, 2))
print(itertools.combinations_with_replacement({1, 2}, 2))
deque.unittest()
priorityqueue.unittest()
