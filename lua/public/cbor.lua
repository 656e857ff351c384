--[[
CBOR with the interface of the older library of that name. New code takes org.conman.cbor.

    encode(value)            bytes; strings become byte strings, also those that are text
    decode(data)             value, next position
    decode_file(file)        the next value of an open file
    simple(number, name), tagged(tag, value)     simple values and tagged values, as objects
    null, undefined          decode gives these objects for null and undefined
    type_encoders            encoder by Lua type; may be extended
    tagged_decoders          decoder by number of tag: function(value) ... end

A table is an array when its keys are 1 to n, also when it is empty; __tocbor(value) of a metatable is followed.
]]

local conman = require 'org.conman.cbor'
local head = require 'org.conman.cbor_c'

local MAX_DEPTH <const> = 500

local cbor = {type_encoders = {}, tagged_decoders = {}}

local Simple = {__tostring = function(value) return value.name or ('simple(%d)'):format(value.value) end}
Simple.__index = Simple
function Simple.__tocbor(value) return head.encode(0xE0, value.value) end

-- @api any simple = cbor.simple(int number, string name = nil)
function cbor.simple(number, name) return setmetatable({value = number, name = name}, Simple) end

local Tagged = {__tostring = function(value) return ('%d(%s)'):format(value.tag, tostring(value.value)) end}
Tagged.__index = Tagged

-- @api any tagged = cbor.tagged(int tag, any value)
function cbor.tagged(tag, value) return setmetatable({tag = tag, value = value}, Tagged) end

cbor.null, cbor.undefined = cbor.simple(22, 'null'), cbor.simple(23, 'undefined')

local function encodeAt(value, depth)
    local kind = type(value)
    local encoder = cbor.type_encoders[kind]
    if not encoder then error("can't encode a " .. kind) end
    return encoder(value, depth)
end

-- @api string bytes = cbor.encode(any value)
function cbor.encode(value) return encodeAt(value, 1) end

function Tagged.__tocbor(value) return head.encode(0xC0, value.tag) .. cbor.encode(value.value) end

local ENCODERS = cbor.type_encoders
local function encodeScalar(value) return conman.encode(value) end
ENCODERS['nil'], ENCODERS.boolean, ENCODERS.number = encodeScalar, encodeScalar, encodeScalar
function ENCODERS.string(value) return head.encode(0x40, #value) .. value end

local function isArray(t)
    local count = 0
    for _ in pairs(t) do count = count + 1 end
    return count == #t
end

local function encodeArray(t, depth)
    local parts = {head.encode(0x80, #t)}
    for i = 1, #t do parts[i + 1] = encodeAt(t[i], depth) end
    return table.concat(parts)
end

local function encodeMap(t, depth)
    local parts, count = {''}, 0
    for key, value in pairs(t) do
        count = count + 1
        parts[2 * count], parts[2 * count + 1] = encodeAt(key, depth), encodeAt(value, depth)
    end
    parts[1] = head.encode(0xA0, count)
    return table.concat(parts)
end

function ENCODERS.table(t, depth)
    if isbuffer(t) then return ENCODERS.string(tostring(t)) end
    local meta = getmetatable(t)
    if type(meta) == 'table' and meta.__tocbor then return meta.__tocbor(t) end
    depth = (depth or 0) + 1
    if depth > MAX_DEPTH then error('nested too deeply: does a table contain itself?') end
    return (isArray(t) and encodeArray or encodeMap)(t, depth)
end

local conversions = {null = function() return cbor.null end, undefined = function() return cbor.undefined end}

-- Tags come as TAG_number, those with a name as _name.
setmetatable(conversions, {__index = function(_, ctype)
    local number = tonumber(ctype:match('^TAG_(%d+)$'))
    if not number then return nil end
    local decoder = cbor.tagged_decoders[number]
    return decoder or function(value) return cbor.tagged(number, value) end
end})

-- @api any value, int next = cbor.decode(buffer data, int pos = 1)
function cbor.decode(data, pos)
    local value, nextPos = conman.decode(data, pos, conversions)
    return value, nextPos
end

-- @api any value = cbor.decode_file(any file)
function cbor.decode_file(file)
    local start = file:seek()
    local value, nextPos = cbor.decode(file:read('a'))
    file:seek('set', start + nextPos - 1)
    return value
end

return cbor
