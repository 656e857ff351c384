-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: libraries 1; base64, base16, cbor, simCBOR
local base64, base16, cbor, simCBOR = require 'base64', require 'base16', require 'cbor', require 'simCBOR'
for _, s in ipairs{'', 'f', 'fo', 'foo', 'foob', '\0\xff\xfe'} do
    local e = base64.encode(s)
    print(isbuffer(e), tostring(e), base64.decode(e) == tobuffer(s), base64.decode((e:gsub('=', ''))) == tobuffer(s))
    print(base16.encode(s), base16.decode(base16.encode(s):lower()) == s)
end
print(base16.encode(base64.decode('_-8 \n')), tostring(base64.encode(tobuffer('abc'))), base16.decode('6') == '\6', base16.decode('61 6') == 'a\6')
print(pcall(base64.decode, 'a'), pcall(base64.decode, 'ab*d'), pcall(base16.decode, 'zz'))
local function hex(s) return base16.encode(s):lower() end
print(hex(cbor.encode{1, 'a', {k = 2.5}}), hex(cbor.encode{}), hex(cbor.encode(cbor.null)), hex(cbor.encode(cbor.tagged(100, 'x'))))
local value = cbor.decode('\x84\xf6\x01\x61a\xd8\x64\x05')
print(value[1] == cbor.null, value[2], value[3], value[4].tag, value[4].value, tostring(value[1]))
cbor.tagged_decoders[100] = function(v) return v + 1 end
print(cbor.decode('\xd8\x64\x05'))
local cycle = {}
cycle[1] = cycle
print((pcall(cbor.encode, cycle)), (pcall(cbor.encode, print)))
local file = io.tmpfile()
file:write(cbor.encode(7), cbor.encode('x'))
file:seek('set')
print(cbor.decode_file(file), cbor.decode_file(file))
local function show(bytes)
    local v, pos, ctype = simCBOR.decode(bytes)
    print(isbuffer(v), v, pos, ctype)
end
show('\x43abc')
show(tobuffer('\xa1\x41k\x41v'))
show('\xd8\x40\x43\1\2\3')
show('\xd8\x55\x48\0\0\x80\x3f\0\0\0\x40')
show('\xd8\x4e\x44\xff\xff\xff\xff')
show('\xc2\x41\x05')
show('\xdb\0\0\0\1\0\0\x33\x94\x87\0\0\0\0\0\0\1')
show('\x82\xda\xff\xff\xff\xff\1\xd8\x40\x41\7')
show('\x82\xdb\0\0\0\0\xff\xff\xff\xff\1\xd8\x40\x41\7')
print(hex(simCBOR.encode{1, simCBOR.null, tobuffer('ab'), 3}), simCBOR.isfloat('half'), simCBOR.TYPE.UINT(1) == '\1', simCBOR._VERSION)
print(pcall(simCBOR.decode, '\x82\1'))
