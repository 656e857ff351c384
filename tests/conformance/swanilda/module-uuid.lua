-- topic: modules
-- as: sandbox
-- passes: 0
-- note: random identifiers
local uuid = require 'uuid'
local a, b = uuid.v4(), uuid()
print(#a, a ~= b, a:find('^%x+%-%x%x%x%x%-4%x%x%x%-[89ab]%x%x%x%-%x+$') ~= nil)
uuid.set_rng(function(n) return ('\xff'):rep(n) end)
print(uuid.v4())
uuid.set_rng(uuid.rng.math_random())
print(#uuid.v4())
