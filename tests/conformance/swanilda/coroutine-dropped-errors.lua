-- topic: coroutines
-- as: sandbox
-- passes: 0
-- spec: threads
-- note: an error in a coroutine is logged where a statement drops what coroutine.resume returns
local function broken(text) return coroutine.create(function() coroutine.yield() error(text) end) end

local dropped = broken('one')
coroutine.resume(dropped)
coroutine.resume(dropped)
coroutine.resume(dropped) -- it is dead: that is no news

local function statement(co) if co then coroutine.resume(co) end return 1 end
local inside = broken('two')
statement(inside)
statement(inside)

-- all of these look at the error
local seen = broken('three')
coroutine.resume(seen)
print(coroutine.resume(seen))
local kept = broken('four')
coroutine.resume(kept)
local ok, message = coroutine.resume(kept)
print(ok, message)
local wrapped = coroutine.wrap(function() error('five') end)
print(pcall(wrapped))
-- an error that is no text
coroutine.resume(coroutine.create(function() error({}) end))
print(select('#', coroutine.resume(coroutine.create(function() return 1, 2 end))))
