-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: libraries 1
-- note: conversions, references, own encoders, the low level
local cbor = require 'org.conman.cbor'
local low = require 'org.conman.cbor_c'
local function hex(s) return (s:gsub('.', function(c) return ('%02x'):format(c:byte()) end)) end
print(cbor.decode('\x82\x01\x61a', 1, {UINT = function(v) return v + 1 end, TEXT = string.upper}))
print(cbor.decode('\xa1\x41k\x41v', 1, {BIN = function(v, iskey) return iskey and v or '<' .. v .. '>' end}))
print(cbor.decode('xx\x01', 3))
local shared = {'a'}
local bytes = cbor.encode({shared, shared}, {})
local back = cbor.decode(bytes)
print(hex(bytes), back[1] == back[2])
local cycle = {}
cycle[1] = cycle
bytes = cbor.encode(cycle, {})
back = cbor.decode(bytes)
print(hex(bytes), back[1] == back)
print(pcall(cbor.encode, cycle) == false, select(2, cbor.pencode(cycle)):match('nested.*'))
bytes = cbor.encode({'hello', 'hello'}, nil, {})
print(hex(bytes), cbor.decode(bytes))
print(hex(cbor.TAG._epoch(0)), hex(cbor.TAG.TAG_100('x')), hex(cbor.SIMPLE.undefined()), hex(cbor.SIMPLE['16']()), hex(cbor.SIMPLE.single(0.5)))
print(cbor.decode(cbor.TAG._uuid('0123456789abcdef')))
cbor.__ENCODE_MAP['function'] = function() return cbor.SIMPLE.null() end
print(hex(cbor.encode({print, 1})))
cbor.__ENCODE_MAP.boolean = function(b) return cbor.TYPE.UINT(b and 1 or 0) end
print(hex(cbor.encode({true, {false}})))
print(cbor.isnumber('UINT'), cbor.isinteger('half'), cbor.isfloat('half'), cbor.isnumber('TEXT'))
print(hex(low.encode(0x80, 3)), hex(low.encode(0x80)), hex(low.encode(0xE0, nil, 1.5)), hex(low.encode(0xE0, 27, 1.5)))
print(low.decode('\x83', 1))
print(low.decode('\xf9\x3e\x00', 1))
print(low.decode('\x9f', 1))
print(pcall(low.decode, '\x19\x00', 1))
print(pcall(low.encode, 7, 1))
