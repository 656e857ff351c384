--[[
The words of a chain that mean little, those that negate, and the message of one's own.
]]

local assert = require 'luassert.core'

for _, word in ipairs{'is', 'are', 'was', 'has', 'does'} do
    assert:register('modifier', word, function(state) return state end)
end

local function negate(state)
    state.mod = not state.mod
    return state
end

assert:register('modifier', 'not', negate)
assert:register('modifier', 'no', negate)

assert:register('modifier', 'message', function(state, arguments, level)
    if not arguments then error("luassert: 'message' needs a text: message(text)", level) end
    state.failure_message = arguments[1]
    return state
end)
