--[[
JSON with the interface of the small library that many scripts bring along. Errors are raised.

A file json.lua beside the scene is loaded instead of this one. Tables with element 1, and empty ones, are arrays; null becomes nil.
]]

local scanner = require 'json_scanner'

local json = {_version = '0.1.2'}
local encodeValue

local function encodeArray(t, above)
    local parts, count = {}, 0
    for key in pairs(t) do
        if type(key) ~= 'number' then error('invalid table: mixed or invalid key types', 0) end
        count = count + 1
    end
    if count ~= #t then error('invalid table: sparse array', 0) end
    for i, value in ipairs(t) do parts[i] = encodeValue(value, above) end
    return '[' .. table.concat(parts, ',') .. ']'
end

local function encodeObject(t, above)
    local parts = {}
    for key, value in pairs(t) do
        if type(key) ~= 'string' then error('invalid table: mixed or invalid key types', 0) end
        parts[#parts + 1] = scanner.quote(key) .. ':' .. encodeValue(value, above)
    end
    return '{' .. table.concat(parts, ',') .. '}'
end

local function encodeTable(t, above)
    if above[t] then error('circular reference', 0) end
    if above.depth >= 500 then error('nested too deeply', 0) end
    above[t], above.depth = true, above.depth + 1
    local text = (rawget(t, 1) ~= nil or next(t) == nil) and encodeArray(t, above) or encodeObject(t, above)
    above[t], above.depth = nil, above.depth - 1
    return text
end

function encodeValue(value, above)
    local kind = math.type(value) or type(value)
    if kind == 'nil' then return 'null' end
    if kind == 'boolean' or kind == 'integer' then return tostring(value) end
    if kind == 'string' or isbuffer(value) then return scanner.quote(tostring(value)) end
    if kind == 'table' then return encodeTable(value, above) end
    if kind ~= 'float' then error(("unexpected type '%s'"):format(kind), 0) end
    if value ~= value or value == math.huge or value == -math.huge then
        error(("unexpected number value '%s'"):format(value), 0)
    end
    return ('%.14g'):format(value)
end

--- The JSON form of a value.
-- @api string text = json.encode(any value)
function json.encode(value)
    local ok, result = pcall(encodeValue, value, {depth = 0})
    if not ok then error(result, 2) end
    return result
end

--- The value of JSON text; null becomes nil.
-- @api any value = json.decode(buffer text)
function json.decode(text)
    if isbuffer(text) then text = tostring(text) end
    if type(text) ~= 'string' then error('expected argument of type string, got ' .. type(text), 2) end
    local value, after, message = scanner.scan(text, 1)
    if message then error(message, 2) end
    local rest = text:find('%S', after)
    if rest then error('trailing garbage at ' .. scanner.place(text, rest), 2) end
    return value
end

return json
