--[[
JSON, with the interface of the library of that name which CoppeliaSim ships.

    encode(value, state)        text; state: {indent = true, keyorder = {...}, level = 0, exception = function(reason, value,
                                state, message), buffer = {}, bufferlen = 0}; raises an error for what JSON cannot hold
    decode(text, pos, nullval, objectmeta, arraymeta)
                                value, next position; nil, position, message for text that is not JSON
    null                        stands for null where nil would leave a hole; decode(text, 1, json.null) gives it back
    quotestring(text), encodeexception (for state.exception), use_lpeg() (this library), version

A table is an array when its keys are 1 to n (or few of those are missing), or its metatable has __jsontype = 'array' ('object' for
the reverse); an empty one is an array. __tojson(value, state) and __jsonorder = {keys} of a metatable are followed. Tables from
decode have a __jsontype. Comments as in JavaScript are skipped.
]]

local scanner = require 'json_scanner'
local type, pairs, tostring, getmetatable, setmetatable = type, pairs, tostring, getmetatable, setmetatable
local concat = table.concat

local MAX_DEPTH <const> = 500

local json = {version = 'dkjson 2.5', quotestring = scanner.quote}

json.null = setmetatable({}, {__tojson = function() return 'null' end, __tostring = function() return 'null' end})

-- @api table json = dkjson.use_lpeg()
function json.use_lpeg() return json end

--- For state.exception: encodes the message as a string.
-- @api string text = dkjson.encodeexception(any reason, any value, table state, string message)
function json.encodeexception(_, _, _, message) return scanner.quote('<' .. message .. '>') end

-- Whether a table is written as an array, and how long.
local function arrayLength(t)
    local largest, count, declared = 0, 0, 0
    for key, value in pairs(t) do
        if key == 'n' and math.type(value) == 'integer' and value >= 0 then
            declared = value
            largest = math.max(largest, value)
        elseif math.type(key) == 'integer' and key > 0 then
            largest, count = math.max(largest, key), count + 1
        else
            return nil
        end
    end
    local isSparse = largest > 10 and largest > declared and largest > count * 2
    if not isSparse and largest - count < 1 << 16 then return largest end
end

local function numberText(number)
    if number ~= number or number == math.huge or number == -math.huge then return 'null' end
    return tostring(number)
end

local encodeValue

-- What cannot be encoded: the exception function may write something instead.
local function refuse(reason, value, state, message)
    local handler = state.exception
    if not handler then error({message = message}, 0) end
    local result, otherMessage = handler(reason, value, state, message)
    if type(result) == 'string' then
        state:write(result)
    elseif not result then
        error({message = otherMessage or message}, 0)
    end
end

local function newLine(state, level)
    if state.indent then state:write('\n' .. ('  '):rep(level)) end
end

local function encodeArray(t, length, state, level)
    state:write('[')
    for i = 1, length do
        if i > 1 then state:write(',') end
        encodeValue(t[i], state, level)
    end
    state:write(']')
end

-- The keys in the order asked for, then the others.
local function orderedKeys(t, order)
    local keys, listed = {}, {}
    for _, key in ipairs(order or {}) do
        if t[key] ~= nil and not listed[key] then
            keys[#keys + 1], listed[key] = key, true
        end
    end
    for key in pairs(t) do
        if not listed[key] then keys[#keys + 1] = key end
    end
    return keys
end

local function encodeObject(t, state, level)
    local meta = getmetatable(t)
    local order = type(meta) == 'table' and meta.__jsonorder or state.keyorder
    state:write('{')
    local first = true
    for _, key in ipairs(orderedKeys(t, order)) do
        if not first then state:write(',') end
        newLine(state, level + 1)
        local kind = type(key)
        if kind == 'string' or kind == 'number' then
            state:write(scanner.quote(tostring(key)) .. ':')
            encodeValue(t[key], state, level + 1)
        else
            refuse('unsupported type', t, state, ("type '%s' is not supported as a key by JSON."):format(kind))
        end
        first = false
    end
    if not first then newLine(state, level) end
    state:write('}')
end

local function encodeTable(t, state, level)
    if state.tables[t] then return refuse('reference cycle', t, state, 'reference cycle') end
    if state.depth >= MAX_DEPTH then return refuse('nesting', t, state, 'nested too deeply') end
    state.tables[t], state.depth = true, state.depth + 1
    local meta = getmetatable(t)
    local jsontype = type(meta) == 'table' and meta.__jsontype
    local length = jsontype ~= 'object' and arrayLength(t)
    if jsontype == 'array' then length = length or #t end
    if length then encodeArray(t, length, state, level) else encodeObject(t, state, level) end
    state.tables[t], state.depth = nil, state.depth - 1
end

local function encodeByMetamethod(value, tojson, state)
    if state.tables[value] then return refuse('reference cycle', value, state, 'reference cycle') end
    state.tables[value] = true
    local result, message = tojson(value, state.caller)
    state.tables[value] = nil
    if not result then return refuse('custom encoder failed', value, state, message or 'custom encoder failed') end
    if type(result) == 'string' then state:write(result) end
end

function encodeValue(value, state, level)
    local meta = type(value) == 'table' and getmetatable(value)
    local tojson = type(meta) == 'table' and meta.__tojson
    local kind = type(value)
    if tojson then
        encodeByMetamethod(value, tojson, state)
    elseif value == nil then
        state:write('null')
    elseif kind == 'number' then
        state:write(numberText(value))
    elseif kind == 'boolean' then
        state:write(tostring(value))
    elseif kind == 'string' then
        state:write(scanner.quote(value))
    elseif kind == 'table' and isbuffer(value) then
        state:write(scanner.quote(tostring(value)))
    elseif kind == 'table' then
        encodeTable(value, state, level)
    else
        refuse('unsupported type', value, state, ("type '%s' is not supported by JSON."):format(kind))
    end
end

local function write(state, text)
    local caller = state.caller
    caller.bufferlen = caller.bufferlen + 1
    caller.buffer[caller.bufferlen] = text
end

-- The state of one call; buffer and bufferlen are the caller's, so that __tojson may add to them.
local function encodingState(caller)
    return {
        caller = caller, indent = caller.indent, keyorder = caller.keyorder, exception = caller.exception,
        tables = caller.tables or {}, depth = 0, write = write,
    }
end

-- @api string text = dkjson.encode(any value, table state = nil)
function json.encode(value, state)
    local caller = state or {}
    local ownBuffer = not caller.buffer
    caller.buffer, caller.bufferlen = caller.buffer or {}, caller.bufferlen or 0
    local ok, reason = pcall(encodeValue, value, encodingState(caller), caller.level or 0)
    local text = ownBuffer and ok and concat(caller.buffer, '', 1, caller.bufferlen)
    if ownBuffer then caller.buffer, caller.bufferlen = nil, nil end
    if not ok then error(type(reason) == 'table' and reason.message or reason, 2) end
    return text or true
end

local OBJECT, ARRAY = {__jsontype = 'object'}, {__jsontype = 'array'}

-- @api any value, int next, string error = dkjson.decode(string text, int pos = 1, any nullval = nil, ...)
function json.decode(text, pos, nullval, ...)
    local objectmeta, arraymeta = OBJECT, ARRAY
    if select('#', ...) > 0 then objectmeta, arraymeta = ... end
    if isbuffer(text) then text = tostring(text) end
    if type(text) ~= 'string' then error("bad argument #1 to 'decode' (string expected)", 2) end
    return scanner.scan(text, pos or 1, nullval, objectmeta, arraymeta)
end

return json
