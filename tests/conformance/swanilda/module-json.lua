-- topic: modules
-- as: sandbox
-- passes: 0
-- note: dkjson and json
local dkjson, json = require 'dkjson', require 'json'
print(dkjson.encode{1, 2.5, 1.0, 'a"\\\n\0é', true, dkjson.null, {}, {a = 1}})
print(dkjson.encode({b = {1, {c = 2}}, a = 1, [3] = 'x'}, {indent = true, keyorder = {'a', 'b'}}))
print(dkjson.encode({[1] = 1, [3] = 3}), dkjson.encode{0 / 0, math.huge}, dkjson.encode{n = 2})
print(dkjson.encode(setmetatable({}, {__jsontype = 'object'})), dkjson.encode(setmetatable({}, {__tojson = function() return '"me"' end})))
local cycle = {}
cycle.x = cycle
for _, bad in ipairs{cycle, {print}, {[true] = 1}} do print(pcall(dkjson.encode, bad)) end
print(dkjson.encode({1, print, cycle}, {exception = dkjson.encodeexception}))
local value, after = dkjson.decode(' {"a": [1, 2.0, -3e2, "\\u00e9\\ud83d\\ude00\\n"], /* c */ "b": null, "c": true} rest')
print(value, after, math.type(value.a[1]), math.type(value.a[2]), getmetatable(value).__jsontype, getmetatable(value.a).__jsontype)
print(dkjson.decode('[null]', 1, dkjson.null)[1] == dkjson.null, getmetatable(dkjson.decode('{}', 1, nil, nil)))
for _, text in ipairs{'', '{', '[1,', '{"a" 1}', '"abc', '[1 2]', '\n  nope', '{null:1}', ('['):rep(100000)} do print(dkjson.decode(text)) end
print(dkjson.use_lpeg() == dkjson, dkjson.quotestring('\u{2028}'))
print(json.encode{1, 'x', {a = 1.5}}, json.encode{}, json.decode('{"a":[1,null,2]}').a[3])
for _, bad in ipairs{cycle, {print}, {1, nil, 3}, {1, a = 2}, {[3] = 1}, math.huge} do print(pcall(json.encode, bad)) end
for _, text in ipairs{'', '[1] x', '{', 5} do print(pcall(json.decode, text)) end
