--[[
CBOR for CoppeliaSim's remote interfaces: everything in org.conman.cbor, and a decoder for the simulator's types.

    decode(data)     byte strings become buffers (not as keys of maps), typed arrays tables of numbers, a matrix (tag 40) an object
                     of the module matrix, a colour a Color, handles, poses and quaternions their numbers; other tags are dropped
    encode(value)    as in org.conman.cbor; objects that have a __tocbor encode themselves
    null             encodes as null, where nil would leave a hole
    Tags             the numbers of the simulator's tags by name, for the module's user and its objects
]]

local _, native = ...
local cbor = require 'org.conman.cbor'

local simCBOR = {}
for name, value in pairs(cbor) do simCBOR[name] = value end

simCBOR.null = setmetatable({}, {__tocbor = cbor.SIMPLE.null, __tostring = function() return 'null' end})

simCBOR.Tags = {
    MATRIX = 40, COLOR = 4294970000, QUATERNION = 4294980000, POSE = 4294980500, HANDLES = 4294999998, HANDLE = 4294999999,
}

local function toMatrix(value)
    local size, data = value[1], value[2]
    if type(size) ~= 'table' or type(data) ~= 'table' then error('tag 40: not a matrix') end
    return require('matrix-2').Matrix(size[1], size[2], data)
end

local function toColor(value)
    local bytes = {tostring(value):byte(1, -1)}
    for i, byte in ipairs(bytes) do bytes[i] = byte / 255 end
    return require('Color')(bytes)
end

-- The names are those of org.conman.cbor for types.
local conversions = {
    BIN = function(value, iskey) return iskey and value or tobuffer(value) end,
    TAG_40 = toMatrix,
    TAG_4294970000 = toColor,
    TAG_4294999999 = function(handle) if handle ~= -1 then return handle end end,
}

local TYPED_ARRAYS = {[64] = 'B', [69] = '<I2', [70] = '<I4', [78] = '<i4', [79] = '<i8', [85] = '<f', [86] = '<d'}

for tag, format in pairs(TYPED_ARRAYS) do
    local size = string.packsize(format)
    conversions['TAG_' .. tag] = function(value)
        if not isbuffer(value) then return value end
        local bytes, numbers = tostring(value), {}
        for i = 1, #bytes // size do numbers[i] = string.unpack(format, bytes, (i - 1) * size + 1) end
        return numbers
    end
end

-- Tags whose values are made here; data without them are decoded natively.
local OWN = {[25] = true, [28] = true, [29] = true, [256] = true, [40] = true, [4294970000] = true, [4294999999] = true}

-- @api any value, int next, string ctype = simCBOR.decode(buffer data)
function simCBOR.decode(data)
    data = tostring(data)
    local ctype, nextPos, value = native.decode(data, 1, OWN, true)
    if ctype then return value, nextPos, ctype end
    return cbor.decode(data, 1, conversions)
end

-- @api buffer bytes = simCBOR.encode(any value)

return simCBOR
