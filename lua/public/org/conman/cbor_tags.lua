--[[
Tags of CBOR by name, the references among tables and strings, and encoders of simple values, for org.conman.cbor.

TAG._name(value) encodes, TAG[number] decodes and checks what the tag is put on. Any other tag: TAG.TAG_100(value), TAG[100].
]]

local M = {}

local NUMBERS = {UINT = true, NINT = true, half = true, single = true, double = true}
local TEXT, BIN, ARRAY, MAP = {TEXT = true}, {BIN = true}, {ARRAY = true}, {MAP = true}

-- Number, and the types it may be put on; any where none is said.
local NAMES = {
    _datetime = {0, TEXT}, _epoch = {1, NUMBERS}, _pbignum = {2, BIN}, _nbignum = {3, BIN}, _decimalfraction = {4, ARRAY},
    _bigfloat = {5, ARRAY}, _tobase64url = {21}, _tobase64 = {22}, _tobase16 = {23}, _cbor = {24, BIN}, _perlobj = {26, ARRAY},
    _serialobj = {27, ARRAY}, _rational = {30, ARRAY}, _url = {32, TEXT}, _base64url = {33, TEXT}, _base64 = {34, TEXT},
    _regex = {35, TEXT}, _mime = {36, TEXT}, _uuid = {37, BIN}, _language = {38, ARRAY}, _id = {39}, _bmime = {257, BIN},
    _decimalfractionexp = {264, ARRAY}, _bigfloatexp = {265, ARRAY}, _indirection = {22098}, _rains = {15309736, MAP},
    _magic_cbor = {55799},
}

--- Whether a string of n bytes is longer than a reference to it, the count-th one.
function M.isWorthAReference(n, count)
    local size = count < 24 and 1 or count < 256 and 2 or count < 65536 and 3 or count < 4294967296 and 5 or 9
    return n >= size + 2
end

local References = {}
References.__index = References

--- What a document being decoded has marked so far.
function M.references()
    return setmetatable({_stringref = false, _sharedref = {}}, References)
end

function References:addString(value, ctype)
    local strings = self._stringref
    if strings and M.isWorthAReference(#value, #strings) then strings[#strings + 1] = {value, ctype} end
end

--- A new table; the one that a mark before it is about.
function References:container()
    local t = {}
    if self.pending then self._sharedref[self.pending], self.pending = t, nil end
    return t
end

-- Encoders and decoders of the named tags.
local function installNames(TAG, TYPE, encode, decode, fail)
    local function wanted(types)
        local list = {}
        for name in pairs(types) do list[#list + 1] = name end
        table.sort(list)
        return table.concat(list, '/')
    end
    for name, definition in pairs(NAMES) do
        local number, types = definition[1], definition[2]
        TAG[name] = function(value, sref, stref)
            local content = types == BIN and TYPE.BIN or types == TEXT and TYPE.TEXT or types == ARRAY and TYPE.ARRAY
                or types == MAP and TYPE.MAP or encode
            return M.head.encode(0xC0, number) .. content(value, sref, stref)
        end
        TAG[number] = function(packet, pos, conv, ref, iskey, depth)
            local value, nextPos, ctype = decode(packet, pos, conv, ref, iskey, depth or 0)
            if types and not types[ctype] then fail(pos, ('%s: wanted %s, got %s'):format(name, wanted(types), ctype)) end
            return value, nextPos, name
        end
    end
end

local function installSharedTables(TAG, encode, decode, fail)
    function TAG._shareable(value, sref, stref) return M.head.encode(0xC0, 28) .. encode(value, sref, stref) end
    function TAG._sharedref(index) return M.head.encode(0xC0, 29) .. M.head.encode(0x00, index) end

    TAG[28] = function(packet, pos, conv, ref, iskey, depth)
        local index = #ref._sharedref + 1
        ref._sharedref[index], ref.pending = false, index
        local value, nextPos, ctype = decode(packet, pos, conv, ref, iskey, depth or 0)
        ref.pending, ref._sharedref[index] = nil, value
        return value, nextPos, ctype
    end

    TAG[29] = function(packet, pos, conv, ref, iskey, depth)
        local index, nextPos, ctype = decode(packet, pos, conv, ref, iskey, depth or 0)
        if ctype ~= 'UINT' then fail(pos, '_sharedref: wanted UINT, got ' .. ctype) end
        local value = ref._sharedref[index + 1]
        if not value then fail(pos, ('_sharedref: no reference %d'):format(index)) end
        return value, nextPos, type(value) == 'table' and '_sharedref' or ctype
    end
end

local function installStrings(TAG, encode, decode, fail)
    function TAG._nthstring(index) return M.head.encode(0xC0, 25) .. M.head.encode(0x00, index) end
    function TAG._stringref(value, sref, stref) return M.head.encode(0xC0, 256) .. encode(value, sref, stref or {SEEN = true}) end

    TAG[25] = function(packet, pos, conv, ref, iskey, depth)
        local index, nextPos, ctype = decode(packet, pos, conv, ref, iskey, depth or 0)
        if ctype ~= 'UINT' then fail(pos, '_nthstring: wanted UINT, got ' .. ctype) end
        local known = ref._stringref and ref._stringref[index + 1]
        if not known then fail(pos, ('_nthstring: no string %d'):format(index)) end
        return known[1], nextPos, known[2]
    end

    TAG[256] = function(packet, pos, conv, ref, iskey, depth)
        local outer = ref._stringref
        ref._stringref = {}
        local value, nextPos, ctype = decode(packet, pos, conv, ref, iskey, depth or 0)
        ref._stringref = outer
        return value, nextPos, ctype
    end
end

local function installSimple(SIMPLE)
    local head = M.head
    SIMPLE['false'] = function() return '\xf4' end
    SIMPLE['true'] = function() return '\xf5' end
    function SIMPLE.null() return '\xf6' end
    function SIMPLE.undefined() return '\xf7' end
    function SIMPLE.half(value) return head.encode(0xE0, 25, value) end
    function SIMPLE.single(value) return head.encode(0xE0, 26, value) end
    function SIMPLE.double(value) return head.encode(0xE0, 27, value) end
    function SIMPLE.__break() return '\xff' end
    -- SIMPLE['16'] encodes that simple value.
    setmetatable(SIMPLE, {__index = function(_, name)
        local number = math.tointeger(tonumber(name))
        return number and function() return head.encode(0xE0, number) end
    end})
end

-- Numbers from 2^63 on are negative integers in Lua.
local function unsigned(number)
    if number >= 0 then return tostring(number) end
    local tens = (number >> 1) // 5
    return tens .. number - tens * 10
end

--- Fills cbor.TAG and cbor.SIMPLE. encode and decode are for the tagged value, fail(pos, message) raises.
function M.install(cbor, encode, decode, fail)
    M.head = require('org.conman.cbor_c')
    local TAG = cbor.TAG
    installSimple(cbor.SIMPLE)
    installNames(TAG, cbor.TYPE, encode, decode, fail)
    installSharedTables(TAG, encode, decode, fail)
    installStrings(TAG, encode, decode, fail)
    return setmetatable(TAG, {__index = function(_, key)
        local number = math.tointeger(key) or math.tointeger(tonumber(tostring(key):match('^TAG_(%d+)$')))
        if not number then return nil end
        if type(key) == 'string' then
            return function(value, sref, stref) return M.head.encode(0xC0, number) .. encode(value, sref, stref) end
        end
        return function(packet, pos, conv, ref, iskey, depth)
            local value, nextPos = decode(packet, pos, conv, ref, iskey, depth or 0)
            return value, nextPos, 'TAG_' .. unsigned(number)
        end
    end})
end

return M
