--[[
CBOR (RFC 8949) for scripts, with the interface of the library of that name which CoppeliaSim ships.

    encode(value, sref, stref)                bytes; raises an error for what CBOR cannot hold
    decode(packet, pos, conv)                 value, next position, type; raises an error for malformed data
    pencode(...), pdecode(...)                the same, returning nil and a message: bytes | nil, message and
                                              value, next, type | nil, position, '__error', message
    isnumber(t), isinteger(t), isfloat(t)     about a type that decode returned
    TYPE, TAG, SIMPLE                         functions that encode one kind: TYPE.MAP({1, 2}), TAG._epoch(0), SIMPLE.undefined()
    __ENCODE_MAP                              encoder by Lua type; may be extended

Only the first argument is needed. conv has functions by type: {BIN = function(value, iskey) return tobuffer(value) end, TAG_85 = ...}.
A table with a metatable is encoded by its __tocbor(value, sref, stref), else as an array (__len) or a map (__pairs). With a table as
sref, a table met twice is written once; with one as stref, a string.

Below it lies org.conman.cbor_c: encode(type, n, x) makes the head of an item (x: a float), decode(packet, pos) reads one and gives
major type, info, number and next position.

Plain values are encoded and decoded natively; the functions here are for all that needs Lua.
]]

local _, native = ...
local head = require('org.conman.cbor_c')
local tags = require('org.conman.cbor_tags')
local type, error, pairs, getmetatable = type, error, pairs, getmetatable
local concat = table.concat

local MAX_DEPTH <const> = 500 -- as in the native part
local TOO_DEEP <const> = 'nested too deeply (500 levels): does a table contain itself?'

local M = {_VERSION = '1.4.0', TYPE = {}, TAG = {}, SIMPLE = {}, __ENCODE_MAP = {}}
local TYPE, TAG, ENCODE = M.TYPE, M.TAG, M.__ENCODE_MAP

local NUMBERS = {UINT = 'integer', NINT = 'integer', half = 'float', single = 'float', double = 'float'}

-- @api bool result = org.conman.cbor.isnumber(string ctype)
function M.isnumber(ctype) return NUMBERS[ctype] ~= nil end
-- @api bool result = org.conman.cbor.isinteger(string ctype)
function M.isinteger(ctype) return NUMBERS[ctype] == 'integer' end
-- @api bool result = org.conman.cbor.isfloat(string ctype)
function M.isfloat(ctype) return NUMBERS[ctype] == 'float' end

---------------------------------------------------------------- encoding

local function encodeAny(value, sref, stref, depth)
    local kind = type(value)
    local encode = ENCODE[kind]
    if not encode then
        local own = kind == 'userdata' and getmetatable(value)
        if own and own.__tocbor then return own.__tocbor(value, sref, stref) end
        error('Cannot encode ' .. kind)
    end
    return encode(value, sref, stref, depth)
end

-- With references: a number instead of a table that was written before, else the mark that makes it one of those.
local function shared(value, sref)
    if not sref then return '' end
    if sref[value] then return nil, TAG._sharedref(sref[value]) end
    sref[#sref + 1] = value
    sref[value] = #sref - 1
    return head.encode(0xC0, 28)
end

local function encodeString(kind, value, stref)
    local bytes = head.encode(kind, #value) .. value
    if not stref then return bytes end
    if stref[bytes] then return TAG._nthstring(stref[bytes]) end
    if tags.isWorthAReference(#value, #stref) then
        stref[#stref + 1] = bytes
        stref[bytes] = #stref - 1
    end
    return bytes
end

local function isText(value) return native.encode(value):byte() & 0xE0 == 0x60 end

function TYPE.UINT(n) return head.encode(0x00, n) end
function TYPE.NINT(n) return head.encode(0x20, -1 - n) end
function TYPE.BIN(value, _, stref) return encodeString(0x40, value, stref) end

function TYPE.TEXT(value, _, stref)
    if not isText(value) then error('TEXT: not UTF-8 text') end
    return encodeString(0x60, value, stref)
end

local function checkDepth(depth)
    depth = (depth or 0) + 1
    if depth > MAX_DEPTH then error(TOO_DEEP) end
    return depth
end

function TYPE.ARRAY(array, sref, stref, depth)
    depth = checkDepth(depth)
    local mark, known = shared(array, sref)
    if known then return known end
    local n = #array
    local parts = {mark .. head.encode(0x80, n)}
    for i = 1, n do parts[i + 1] = encodeAny(array[i], sref, stref, depth) end
    return concat(parts)
end

function TYPE.MAP(map, sref, stref, depth)
    depth = checkDepth(depth)
    local mark, known = shared(map, sref)
    if known then return known end
    local parts, n = {''}, 0
    for key, value in pairs(map) do
        n = n + 1
        parts[2 * n] = encodeAny(key, sref, stref, depth)
        parts[2 * n + 1] = encodeAny(value, sref, stref, depth)
    end
    parts[1] = mark .. head.encode(0xA0, n)
    return concat(parts)
end

ENCODE['nil'] = native.encode
ENCODE.boolean = native.encode
ENCODE.number = native.encode

function ENCODE.string(value, sref, stref)
    return (isText(value) and TYPE.TEXT or TYPE.BIN)(value, sref, stref)
end

function ENCODE.table(value, sref, stref, depth)
    local meta = getmetatable(value)
    if meta == nil then return (#value > 0 and TYPE.ARRAY or TYPE.MAP)(value, sref, stref, depth) end
    if type(meta) ~= 'table' then error('Cannot encode table') end
    if meta.__tocbor then return meta.__tocbor(value, sref, stref) end
    if isbuffer(value) then return TYPE.BIN(tostring(value), sref, stref) end
    if meta.__len then return TYPE.ARRAY(value, sref, stref, depth) end
    if meta.__pairs then return TYPE.MAP(value, sref, stref, depth) end
    error('Cannot encode table')
end

local ofNil, ofBoolean, ofNumber, ofString, ofTable = native.encode, native.encode, native.encode, ENCODE.string, ENCODE.table

-- Whether a script has put an encoder of its own in the place of one the native part stands for.
local function isChanged()
    return ENCODE.table ~= ofTable or ENCODE.string ~= ofString or ENCODE.number ~= ofNumber
        or ENCODE.boolean ~= ofBoolean or ENCODE['nil'] ~= ofNil
end

-- @api string bytes = org.conman.cbor.encode(any value, table sref = nil, table stref = nil)
function M.encode(value, sref, stref)
    if stref and not stref.SEEN then
        stref.SEEN = true
        return TAG._stringref(value, sref, stref)
    end
    if not sref and not stref and not isChanged() then
        local bytes, message = native.encode(value)
        if bytes then return bytes end
        if message then error(message) end
    end
    return encodeAny(value, sref, stref)
end

-- @api string bytes, string error = org.conman.cbor.pencode(any value, table sref = nil, table stref = nil)
function M.pencode(value, sref, stref)
    local ok, result = pcall(M.encode, value, sref, stref)
    if ok then return result end
    return nil, result
end

function TYPE.TAG(number, value, sref, stref) return head.encode(0xC0, number) .. encodeAny(value, sref, stref) end

---------------------------------------------------------------- decoding

-- Errors of this part: a table that M.decode and M.pdecode turn into words.
local function fail(pos, message) error({message = message, pos = pos}, 0) end

local decodeAny

local function readHead(packet, pos)
    local kind, info, value, nextPos = native.head(packet, pos)
    if not kind then fail(pos, info) end
    return kind, info, value, nextPos
end

local function decodeString(name, kind)
    return function(packet, pos, info, length, _, ref)
        if info ~= 31 then
            if length < 0 or length > #packet - pos + 1 then fail(pos, 'no more input') end
            local value = packet:sub(pos, pos + length - 1)
            ref:addString(value, name)
            return value, pos + length, name
        end
        local parts = {}
        while true do
            local partKind, partInfo, partLength, start = readHead(packet, pos)
            if partKind == 0xE0 and partInfo == 31 then return concat(parts), start, name end
            if partKind ~= kind or partInfo == 31 then
                fail(pos, 'a string of unknown length consists of strings of its type')
            end
            if partLength < 0 or partLength > #packet - start + 1 then fail(start, 'no more input') end
            parts[#parts + 1] = packet:sub(start, start + partLength - 1)
            pos = start + partLength
        end
    end
end

TYPE[0x00] = function(_, pos, _, value) return value, pos, 'UINT' end
TYPE[0x20] = function(_, pos, _, value) return ~value, pos, 'NINT' end
TYPE[0x40] = decodeString('BIN', 0x40)
TYPE[0x60] = decodeString('TEXT', 0x60)

TYPE[0x80] = function(packet, pos, info, length, conv, ref, _, depth)
    local array, value, ctype = ref:container(), nil, nil
    local i = 0
    while i ~= length do
        value, pos, ctype = decodeAny(packet, pos, conv, ref, false, depth)
        if ctype == '__break' then
            if info ~= 31 then fail(pos, 'unexpected break') end
            break
        end
        i = i + 1
        array[i] = value
    end
    return array, pos, 'ARRAY'
end

TYPE[0xA0] = function(packet, pos, info, length, conv, ref, _, depth)
    local map, key, value, ctype = ref:container(), nil, nil, nil
    local i = 0
    while i ~= length do
        key, pos, ctype = decodeAny(packet, pos, conv, ref, true, depth)
        if ctype == '__break' and info == 31 then break end
        if ctype == '__break' then fail(pos, 'unexpected break') end
        if key == nil or key ~= key then fail(pos, key == nil and 'table index is nil' or 'table index is NaN') end
        value, pos, ctype = decodeAny(packet, pos, conv, ref, false, depth)
        if ctype == '__break' then fail(pos, 'unexpected break') end
        map[key] = value
        i = i + 1
    end
    return map, pos, 'MAP'
end

TYPE[0xC0] = function(packet, pos, _, number, conv, ref, iskey, depth)
    return TAG[number](packet, pos, conv, ref, iskey, depth)
end

local SIMPLE_NAMES <const> = {[20] = 'false', [21] = 'true', [22] = 'null', [23] = 'undefined'}
local FLOAT_NAMES <const> = {[25] = 'half', [26] = 'single', [27] = 'double', [31] = '__break'}

TYPE[0xE0] = function(_, pos, info, value)
    if FLOAT_NAMES[info] then
        if info == 31 then value = false end
        return value, pos, FLOAT_NAMES[info]
    end
    local name = SIMPLE_NAMES[value]
    if not name then return value, pos, 'SIMPLE' end
    if value >= 22 then return nil, pos, name end
    return value == 21, pos, name
end

function decodeAny(packet, pos, conv, ref, iskey, depth)
    depth = depth + 1
    if depth > MAX_DEPTH then fail(pos, TOO_DEEP) end
    local kind, info, number, start = readHead(packet, pos)
    local value, nextPos, ctype = TYPE[kind](packet, start, info, number, conv, ref, iskey, depth)
    local convert = conv[ctype]
    if convert then value = convert(value, iskey) end
    return value, nextPos, ctype
end

-- What a tag is put on: not the end of something else.
local function decodeTagged(packet, ...)
    local value, pos, ctype = decodeAny(packet, ...)
    if ctype == '__break' then fail(pos, 'unexpected break') end
    return value, pos, ctype
end

tags.install(M, encodeAny, decodeTagged, fail)

-- true, value, next, type | false, message, position
local function tryDecode(packet, pos, conv, ref, iskey)
    if isbuffer(packet) then packet = tostring(packet) end
    pos = pos or 1
    if not ref and (not conv or next(conv) == nil) then
        local ctype, nextPos, value = native.decode(packet, pos, TAG, false)
        if ctype then return true, value, nextPos, ctype end
        if nextPos then return false, nextPos, value end
    end
    local results = table.pack(pcall(decodeAny, packet, pos, conv or {}, ref or tags.references(), iskey or false, 0))
    if results[1] then return true, results[2], results[3], results[4] end
    local reason = results[2]
    if type(reason) ~= 'table' or not reason.pos then error(reason, 0) end
    return false, reason.message, reason.pos
end

-- @api any value, int next, string ctype = org.conman.cbor.decode(buffer packet, int pos = 1, table conv = nil, table ref = nil, bool iskey = false)
function M.decode(packet, pos, conv, ref, iskey)
    local ok, value, nextPos, ctype = tryDecode(packet, pos, conv, ref, iskey)
    if not ok then error(('%s at byte %d'):format(value, nextPos), 2) end
    return value, nextPos, ctype
end

-- @api any value, int next, string ctype, string error = org.conman.cbor.pdecode(buffer packet, int pos = 1, table conv = nil, table ref = nil, bool iskey = false)
function M.pdecode(packet, pos, conv, ref, iskey)
    local ok, value, nextPos, ctype = tryDecode(packet, pos, conv, ref, iskey)
    if ok then return value, nextPos, ctype end
    return nil, nextPos, '__error', value
end

return M
