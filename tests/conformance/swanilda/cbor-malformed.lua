-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: libraries 1
-- note: what is no CBOR, and what should not be decoded or encoded
local cbor = require 'org.conman.cbor'
local conv = {UINT = function(v) return v end} -- with a conversion the Lua part decodes
local inputs = {
    '\x81', '\x9b\xff\xff\xff\xff\xff\xff\xff\xff', '\x7b\xff\xff\xff\xff\xff\xff\xff\xff', '\x5b\x7f\xff\xff\xff\xff\xff\xff\xff',
    '\xbb\x00\xff\xff\xff\xff\xff\xff\xff', '\x81\xff', '\xa1\x01\xff', '\xbf\x01\xff', '\x5f\x61a\xff', '\x5f\x5f\xff\xff', '\x1c', '\x1f',
    '\xdf\x01', '\x9f\x01', '\x62a', '\xa1\xf9\x7e\x00\x01', '\xd9\x01\x00\xd8\x19\x00', '\xd8\x1d\x00', '\xd8\x1c', '\xc1\x61a',
}
for i, input in ipairs(inputs) do
    local value, pos, ctype, message = cbor.pdecode(input)
    local value2, pos2, ctype2, message2 = cbor.pdecode(input, 1, conv)
    print(i, ctype, message, value == nil and value2 == nil and ctype == ctype2)
    if message ~= message2 then print('', message2) end
end
for _, byte in ipairs{'\x81', '\x9f', '\xc6', '\xa1\x01', '\xbf\x01', '\xd8\x1c\x81'} do
    local deep = byte:rep(100000)
    print(select(4, cbor.pdecode(deep)), select(4, cbor.pdecode(deep, 1, conv)))
end
print(pcall(cbor.decode, '\x01', 99))
print(pcall(cbor.decode, '\x01', -1))
print(pcall(cbor.decode, '\x01', math.mininteger))
for _, nonsense in ipairs{{}, true, print, 7} do print((pcall(cbor.decode, nonsense))) end
print((pcall(cbor.decode)), (pcall(cbor.decode, '\x01', 'x')))
local big = ('\xff'):rep(100000000)
print(#cbor.encode(big), #cbor.decode(cbor.encode(big)))
local holes = {1}
for i = 1, 62 do holes[1 << i] = 1 end
print((pcall(cbor.encode, holes)))
local nested = setmetatable({}, {__len = function() return 1 end, __index = function(t) return t end})
print(select(2, cbor.pencode(nested)):match('nested.*'))
local endless = setmetatable({}, {__tocbor = function(self) return cbor.encode({self}) end})
print((pcall(cbor.encode, endless)))
print((pcall(cbor.encode, setmetatable({}, {__metatable = 'locked'}))), (pcall(cbor.encode, coroutine.create(print))))
local laughs = {big}
for _ = 1, 40 do laughs = {laughs, laughs} end
print(select(2, cbor.pencode(laughs)):match('Cannot.*'))
