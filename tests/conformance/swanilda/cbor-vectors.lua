-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: cbor 1, cbor 2
-- note: integers beyond 2^53 and holes are where Swanilda differs (docs/DIFFERENCES.md); the rest is recorded
local cbor = require 'org.conman.cbor'
local function hex(s) return (s:gsub('.', function(c) return ('%02x'):format(c:byte()) end)) end
local function unhex(s) return (s:gsub('%x%x', function(h) return string.char(tonumber('0x' .. h)) end)) end
local nan = 0 / 0
local vectors = {
    {{}, 'a0'}, {{1, 2, 3}, '83010203'}, {{1.0, 2.5, 0.1}, '83f93c00f94100fb3fb999999999999a'}, {{a = 1}, 'a1616101'},
    {true, 'f5'}, {false, 'f4'}, {0, '00'}, {23, '17'}, {24, '1818'}, {255, '18ff'}, {256, '190100'}, {65535, '19ffff'},
    {65536, '1a00010000'}, {4294967295, '1affffffff'}, {4294967296, '1b0000000100000000'},
    {9007199254740992, '1b0020000000000000'}, {9007199254740993, '1b0020000000000001'},
    {math.maxinteger, '1b7fffffffffffffff'}, {-1, '20'}, {-24, '37'}, {-25, '3818'}, {-256, '38ff'}, {-257, '390100'},
    {math.mininteger, '3b7fffffffffffffff'}, {0.0, 'f90000'}, {-0.0, 'f98000'}, {1.0, 'f93c00'}, {0.5, 'f93800'}, {1.5, 'f93e00'},
    {65504.0, 'f97bff'}, {65505.0, 'fa477fe100'}, {100000.0, 'fa47c35000'}, {0.1, 'fb3fb999999999999a'},
    {3.14, 'fb40091eb851eb851f'}, {1e300, 'fb7e37e43c8800759c'}, {2.0 ^ -24, 'f90001'}, {math.huge, 'f97c00'},
    {-math.huge, 'f9fc00'}, {'abc', '63616263'}, {'', '60'}, {'é', '62c3a9'}, {'a\0b', '43610062'}, {'\x7f', '417f'},
    {'\xff', '41ff'}, {'\x1b[0m', '441b5b306d'}, {'a\tb\n', '646109620a'}, {utf8.char(0x1F600), '64f09f9880'},
    {utf8.char(0x10FFFF), '44f48fbfbf'}, {{1, nil, 3}, '8301f603'}, {{1, 2, nil, 4}, '840102f604'}, {{[1] = 1, [3] = 3}, '8101'},
    {{[0] = 1}, 'a10001'}, {{[2] = 5}, 'a10205'}, {{1, 2, x = 3}, '820102'}, {{[1.5] = 'a'}, 'a1f93e006161'},
    {tobuffer('abc'), '43616263'}, {setmetatable({}, {__tocbor = function() return 'Bxy' end}), '427879'},
    {setmetatable({}, {__len = function() return 2 end, __index = function(_, i) return i end}), '820102'},
    {setmetatable({}, {__pairs = function() return next, {k = 1} end}), 'a1616b01'},
}
local wrong = 0
for _, vector in ipairs(vectors) do
    local bytes = hex(cbor.encode(vector[1]))
    if bytes ~= vector[2] then
        wrong = wrong + 1
        print(vector[1], bytes, vector[2])
    end
end
print(#vectors, 'vectors', wrong, 'wrong')
print(hex(cbor.encode(nil)), hex(cbor.encode(nan)):find('^f9[7f]e00$') ~= nil)
print(hex(cbor.TYPE.ARRAY({})), hex(cbor.TYPE.MAP({1, 2})), hex(cbor.TYPE.BIN('abc')))
print((cbor.pencode(print)), select(2, cbor.pencode(print)):match('Cannot encode.*'))
print(select(2, cbor.pencode(setmetatable({}, {}))):match('Cannot encode.*'))
print(select(2, pcall(cbor.TYPE.TEXT, '\xff')):match('TEXT:.*'), select(2, pcall(cbor.TYPE.TEXT, 'a\0')):match('TEXT:.*'))
local inputs = [[80 a0 83010203 8301f603 82f601 9f0102ff bf616101ff 1bffffffffffffffff 3bffffffffffffffff 1b8000000000000000 f97e00
    f97c00 fa3f800000 fb3ff0000000000000 f93c00 43010203 5f42010243030405ff 7f61616162ff c11a514b67b0 d8641863 f7 f6 e0 a10102
    a1416101 ff d81c8101]]
for input in inputs:gmatch('%x+') do
    local value, pos, ctype = cbor.decode(unhex(input))
    print(input, type(value) == 'string' and hex(value) or value, math.type(value), pos == #input // 2 + 1, ctype)
end
for _, input in ipairs{'c24900ffffffffffffffff', 'd84043010203', 'd855480000803f00000040'} do
    local value, pos, ctype = cbor.decode(unhex(input))
    print(hex(value), pos, ctype)
end
for _, input in ipairs{'d82500', 'a1f601', '18', ''} do print(cbor.pdecode(unhex(input))) end
