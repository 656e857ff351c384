--[[
Sources, sinks, filters and pumps: data that flows in chunks.

    filter.cycle(low, context, extra), filter.chain(...)
    source.empty(), error(message), file(handle, message), simplify(source), string(text), table(list), rewind(source),
        chain(source, ...), cat(...)
    sink.table(list), simplify(sink), file(handle, message), null(), error(message), chain(..., sink)
    pump.step(source, sink), pump.all(source, sink, step)

A source gives a chunk, nil at its end, or nil and a message. A sink takes them and returns 1, or nil and a message. A filter takes a
chunk and returns another; it gets nil at the end and returns nil when it has nothing left.
]]

local ltn12 = {filter = {}, source = {}, sink = {}, pump = {}, BLOCKSIZE = 2048, _VERSION = 'LTN12 1.0.3'}
local filter, source, sink, pump = ltn12.filter, ltn12.source, ltn12.sink, ltn12.pump
local unpack = table.unpack

---------------------------------------------------------------- filters

-- A filter of a function that takes its context and a chunk, and returns a chunk and the context.
function filter.cycle(low, context, extra)
    assert(low, "bad argument #1 to 'cycle' (function expected)")
    return function(chunk)
        local out
        out, context = low(context, chunk, extra)
        return out
    end
end

-- At the end the first is asked until it has nothing left, then the second.
local function pairAtEnd(first, second)
    while true do
        local rest = first(nil)
        if rest == nil then return second(nil) end
        local out = second(rest)
        if out ~= '' then return out end
    end
end

-- Two filters in a row. Either may give several chunks for one: it is asked with '' for more.
local function pair(first, second)
    return function(chunk)
        if chunk == nil then return pairAtEnd(first, second) end
        if chunk == '' then
            local more = second('')
            if more ~= '' then return more end
        end
        local out = first(chunk)
        while out ~= '' do
            local final = second(out)
            if final ~= '' then return final end
            out = first('')
        end
        return ''
    end
end

function filter.chain(...)
    local chained = ...
    for i = 2, select('#', ...) do chained = pair(chained, (select(i, ...))) end
    return chained
end

---------------------------------------------------------------- sources

local function nothing() return nil end

function source.empty() return nothing end

function source.error(message) return function() return nil, message end end

function source.file(handle, message)
    if not handle then return source.error(message or 'unable to open file') end
    return function()
        local chunk = handle:read(ltn12.BLOCKSIZE)
        if not chunk then handle:close() end
        return chunk
    end
end

-- A source that may give another source with its chunk, to go on with.
function source.simplify(fancy)
    assert(fancy, "bad argument #1 to 'simplify' (source expected)")
    return function()
        local chunk, other = fancy()
        if chunk == nil then return nil, other end
        fancy = other or fancy
        return chunk
    end
end

function source.string(text)
    if not text then return source.empty() end
    local position = 1
    return function()
        local chunk = text:sub(position, position + ltn12.BLOCKSIZE - 1)
        position = position + ltn12.BLOCKSIZE
        if chunk ~= '' then return chunk end
    end
end

function source.table(list)
    assert(type(list) == 'table', "bad argument #1 to 'table' (table expected)")
    local i = 0
    return function()
        i = i + 1
        return list[i]
    end
end

-- A source that takes chunks back.
function source.rewind(from)
    assert(from, "bad argument #1 to 'rewind' (source expected)")
    local returned = {}
    return function(chunk)
        if chunk ~= nil then
            returned[#returned + 1] = chunk
        elseif #returned > 0 then
            return table.remove(returned)
        else
            return from()
        end
    end
end

-- A filter may give several chunks for one: it is asked with '' until it gives '', and with nil at the end until it gives nil.
local function filtered(from, through)
    local input, isFresh = nil, true
    return function()
        while true do
            if isFresh then
                local message
                input, message = from()
                if message then return nil, message end
            end
            local out = through(input)
            if out == nil then
                if input ~= nil then error('filter returned inappropriate nil') end
                return nil
            end
            isFresh = out == ''
            if isFresh and input == nil then error('filter returned ""') end
            if not isFresh then
                input = input and ''
                return out
            end
        end
    end
end

function source.chain(from, ...)
    assert(from and ..., "bad argument to 'chain' (source and filter expected)")
    local chained = from
    for i = 1, select('#', ...) do chained = filtered(chained, (select(i, ...))) end
    return chained
end

-- One source after the other.
function source.cat(...)
    local sources = {...}
    local current = table.remove(sources, 1)
    return function()
        while current do
            local chunk, message = current()
            if chunk ~= nil then return chunk end
            if message then return nil, message end
            current = table.remove(sources, 1)
        end
    end
end

---------------------------------------------------------------- sinks

function sink.table(list)
    list = list or {}
    return function(chunk)
        if chunk ~= nil then list[#list + 1] = chunk end
        return 1
    end, list
end

-- A sink that may return another sink, to go on with.
function sink.simplify(fancy)
    assert(fancy, "bad argument #1 to 'simplify' (sink expected)")
    return function(chunk, message)
        local ok, other = fancy(chunk, message)
        if not ok then return nil, other end
        fancy = other or fancy
        return 1
    end
end

function sink.file(handle, message)
    if not handle then return sink.error(message or 'unable to open file') end
    return function(chunk)
        if chunk ~= nil then return handle:write(chunk) end
        handle:close()
        return 1
    end
end

local function null() return 1 end

function sink.null() return null end

function sink.error(message) return function() return nil, message end end

function sink.chain(...)
    local parts = {...}
    local last = table.remove(parts)
    assert(last and #parts > 0, "bad argument to 'chain' (filter and sink expected)")
    local through = filter.chain(unpack(parts))
    return function(chunk, message)
        if chunk == '' then return 1 end
        local rest = chunk and ''
        local out = through(chunk)
        while true do
            local ok, failure = last(out, message)
            if not ok then return nil, failure end
            if out == rest then return 1 end
            out = through(rest)
        end
    end
end

---------------------------------------------------------------- pumps

-- One chunk; nothing once the source has ended or something failed.
function pump.step(from, to)
    local chunk, message = from()
    local ok, failure = to(chunk, message)
    if chunk ~= nil and ok then return 1 end
    return nil, message or failure
end

function pump.all(from, to, step)
    assert(from and to, "bad argument to 'all' (source and sink expected)")
    step = step or pump.step
    while true do
        local ok, message = step(from, to)
        if not ok then
            if message then return nil, message end
            return 1
        end
    end
end

return ltn12
