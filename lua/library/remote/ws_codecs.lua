--[[
The two encodings of the WebSocket remote API. The first byte of a message distinguishes them.

A codec is {opcode, success = function(id, results), failure = function(id, message)}.
]]

local simWS = require('simWS')
local cbor = require('org.conman.cbor')
local json = require('dkjson')
local head = require('org.conman.cbor_c').encode

local M = {}

-- Results as a list; those that are nil at its end are left out.
local function lengthOf(results)
    local n = results.n
    while n > 0 and results[n] == nil do n = n - 1 end
    return n
end

---------------------------------------------------------------- JSON

local JSON <const> = {opcode = simWS.opcode.text}

local function jsonText(reply)
    local text = json.encode(reply)
    if not utf8.len(text) then error('JSON has no place for bytes that are no UTF-8; CBOR has', 0) end
    return text
end

function JSON.success(id, results)
    local list
    if results then
        list = setmetatable({}, {__jsontype = 'array'})
        for i = 1, lengthOf(results) do list[i] = results[i] == nil and json.null or results[i] end
    end
    return jsonText{id = id, success = true, ret = list}
end

-- An error message may quote any bytes.
function JSON.failure(id, message)
    if not utf8.len(message) then message = message:gsub('[\x80-\xff]', '?') end
    return jsonText{id = id, success = false, error = message}
end

---------------------------------------------------------------- CBOR

local CBOR <const> = {opcode = simWS.opcode.binary}

-- A map of pairs that are encoded already.
local function cborMap(parts) return head(0xa0, #parts // 2) .. table.concat(parts) end

local function cborList(results)
    local n = lengthOf(results)
    if n == 0 then return '\xa0' end
    local parts = {head(0x80, n)}
    for i = 1, n do parts[i + 1] = cbor.encode(results[i]) end
    return table.concat(parts)
end

local function withId(id, parts)
    if id ~= nil then
        parts[#parts + 1] = '\x62id'
        parts[#parts + 1] = cbor.encode(id)
    end
    return cborMap(parts)
end

function CBOR.success(id, results)
    local parts = {'\x67success', '\xf5'}
    if results then
        parts[3], parts[4] = '\x63ret', cborList(results)
    end
    return withId(id, parts)
end

function CBOR.failure(id, message)
    return withId(id, {'\x67success', '\xf4', '\x65error', cbor.encode(message)})
end

---------------------------------------------------------------- replies

--- The bytes of a reply: results, or an error. What cannot be encoded becomes an error, with the id unless it is the id.
function M.reply(codec, id, ok, outcome)
    if ok then
        local done, bytes = pcall(codec.success, id, outcome)
        if done then return bytes end
        outcome = bytes
    end
    local message = type(outcome) == 'table' and rawget(outcome, 'message') or outcome
    local done, bytes = pcall(codec.failure, id, tostring(message))
    return done and bytes or codec.failure(nil, 'the id cannot be encoded')
end

---------------------------------------------------------------- requests

local function decodedBy(decode, bytes)
    local ok, value = pcall(decode, bytes)
    return ok and type(value) == 'table' and value or nil
end

--- The request in a message and its codec; nothing when it is none.
function M.decode(bytes)
    if bytes:byte() == 0x7b then
        local request = decodedBy(json.decode, bytes)
        if request then return request, JSON end
    end
    local request = decodedBy(cbor.decode, bytes)
    if request then return request, CBOR end
end

return M
