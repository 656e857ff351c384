--[[
Encodes results, errors and callbacks of the ZeroMQ remote API.
]]

local cbor = require('org.conman.cbor')
local head = require('org.conman.cbor_c').encode
local encode, concat = cbor.encode, table.concat
local type, getmetatable, pairs, next, xpcall, tostring = type, getmetatable, pairs, next, xpcall, tostring

local M = {}

local MISMATCH <const> = "The client ZeroMQ remote API version does not match CoppeliaSim's version"

M.MISMATCH = encode({success = false, error = MISMATCH})
M.EMPTY = encode({})

local NO_RESULT <const> = '\xa1\x63ret\xa0'
local RESULTS <const> = '\xa1\x63ret'
local NO_TYPES <const> = {}

local MAX_DECLARED <const>, MAX_NAME <const> = 10000, 200 -- functions whose types are remembered, and the length of their names
local declared, declaredCount = {}, 0

--- The types that a function is declared to return, which `returns` knows; false where there are none.
function M.typesOf(func, returns)
    local types = declared[func]
    if types ~= nil then return types end
    types = returns(func) or false
    if #func > MAX_NAME then return types end
    if declaredCount >= MAX_DECLARED then declared, declaredCount = {}, 0 end
    declared[func], declaredCount = types, declaredCount + 1
    return types
end

--- Functions of clients as clients write them. One that a function has received comes back as that text, for instance in the parameters
--- of sim.moveToConfig, which are its result as well.
M.names = setmetatable({}, {__mode = 'k'})

-- The value with texts in place of functions of clients, which are at most in tables of tables; false when there are none.
local function withNames(value, depth)
    if type(value) == 'function' then return M.names[value] or false end
    if depth == 0 or type(value) ~= 'table' or getmetatable(value) then return false end
    local copy, isChanged = {}, false
    for key, entry in pairs(value) do
        local changed = withNames(entry, depth - 1)
        copy[key] = changed or entry
        isChanged = isChanged or changed ~= false
    end
    return isChanged and copy
end

local function asItIs(message) return message end

-- Looks for functions only in what cannot be encoded. Not by pcall, which takes longer: it forbids yielding meanwhile.
local function encodeAny(value)
    local ok, bytes = xpcall(encode, asItIs, value)
    if ok then return bytes end
    local named = withNames(value, 2)
    if named then return encode(named) end
    error(bytes, 0)
end

local function countKeys(t)
    local n = 0
    for _ in pairs(t) do n = n + 1 end
    return n
end

-- An array as long as it has only keys from 1 on, also when it is empty.
local function encodeTable(t)
    if next(t) == nil then return '\x80' end
    if #t > 0 and countKeys(t) ~= #t then return cbor.TYPE.MAP(withNames(t, 2) or t) end
    return encodeAny(t)
end

-- The types a function is declared to return; only they tell text from bytes, and an empty list from an empty map.
local function encodeResult(value, declared)
    if declared and type(value) == 'table' and not getmetatable(value) then return encodeTable(value) end
    return encodeAny(value)
end

-- The first result, as what comes before its bytes and these: pictures are long, and each copy of them takes time.
local function encodeFirst(value, declared)
    if type(value) == 'string' then
        if declared == 'string' then return '', cbor.TYPE.TEXT(value) end
        if declared == 'buffer' then return head(0x40, #value), value end
    end
    return '', encodeResult(value, declared)
end

--- The answer with results.
function M.results(results, types)
    local n = results.n
    if n == 0 then return NO_RESULT end
    types = types or NO_TYPES
    local before, first = encodeFirst(results[1], types[1])
    if n == 1 then return RESULTS .. '\x81' .. before .. first end
    if n == 2 then return RESULTS .. '\x82' .. before .. first .. encodeResult(results[2], types[2]) end
    local parts = {RESULTS, head(0x80, n), before, first}
    for i = 2, n do parts[i + 3] = encodeResult(results[i], types[i]) end
    return concat(parts)
end

--- The answer with an error, in one line.
function M.failure(message)
    local text = tostring(message):gsub('\nstack traceback:.*', ''):gsub('\n', '_=NL=_'):gsub('\t', '_=TB=_')
    return encode({err = text})
end

--- A call of a function of the client. Clients receive a list, which ends with the last argument that is not nil.
function M.call(name, args)
    local n = args.n
    while n > 0 and args[n] == nil do n = n - 1 end
    local parts = {'\xa2\x64func', cbor.TYPE.TEXT(name), '\x64args', n == 0 and '\xa0' or head(0x80, n)}
    for i = 1, n do parts[i + 4] = encodeAny(args[i]) end
    return concat(parts)
end

M.WAIT = M.call('_*wait*_', {n = 0})
M.REPEAT = M.call('_*repeat*_', {n = 0})

--- A list of things that are encoded already; encodes as such.
function M.list(parts)
    local bytes = head(0x80, #parts) .. concat(parts)
    return setmetatable({}, {__tocbor = function() return bytes end})
end

return M
