--[[
Checks of what assertions and matchers are called with. `level` is that of the caller to blame, seen from the assertion.
]]

local failure = require 'luassert.failure'
local formatters = require 'luassert.formatters'
local say = require 'luassert.say'
local util = require 'luassert.util'

local arguments = {}

--- Notes a message of the caller's own, if there is one.
function arguments.message(state, message)
    if message ~= nil then state.failure_message = message end
end

function arguments.atLeast(count, list, name, level)
    if list.n >= count then return end
    failure.raise(say('assertion.internal.argtolittle', {name, count, list.n}), level + 1)
end

--- An error about argument `index`. `got` is its type or text.
function arguments.refuse(index, name, expected, got, level)
    failure.raise(say('assertion.internal.badargtype', {index, name, expected, got}), level + 1)
end

--- A value as messages show it.
function arguments.shown(value) return formatters.format{value, n = 1}[1] end

function arguments.callable(list, name, level)
    if not util.callable(list[1]) then
        arguments.refuse(1, name, 'function or callable object', type(list[1]), level + 1)
    end
    return list[1]
end

function arguments.number(list, index, name, level)
    local value = tonumber(list[index])
    if value then return value end
    local got = arguments.shown(list[index])
    arguments.refuse(index, name, 'number or object convertible to a number', got, level + 1)
end

--- A Lua pattern, and where and how to look for it as in `string.find`; a message of the caller's own stands in place of these or after them.
function arguments.pattern(list, index, options, name, level)
    local pattern, init, plain, message = list[index], table.unpack(list, options, options + 2)
    if type(pattern) ~= 'string' then arguments.refuse(index, name, 'string', type(pattern), level + 1) end
    if init ~= nil and type(init) ~= 'number' then return {pattern}, init end
    if plain ~= nil and type(plain) ~= 'boolean' then return {pattern, init}, plain end
    return {pattern, init, plain}, message
end

--- The text a pattern is looked for in, or nil where the value is none.
function arguments.text(value)
    if type(value) == 'string' or type(value) == 'number' or util.hastostring(value) then return tostring(value) end
end

--- The captures of a pattern in a text, or the whole match; nil where there is none.
function arguments.find(text, pattern, level)
    local found = table.pack(pcall(string.find, text, table.unpack(pattern, 1, 3)))
    if not found[1] then error(found[2], level + 1) end
    if not found[2] then return nil end
    if found.n == 3 then return {text:sub(found[2], found[3]), n = 1} end
    return table.move(found, 4, found.n, 1, {n = found.n - 3})
end

return arguments
