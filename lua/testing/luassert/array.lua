--[[
`assert.array(t).has.holes([length])`: whether an index up to the largest, or to a length, has no value.
]]

local assert = require 'luassert.core'
local check = require 'luassert.arguments'

local function largestIndex(t)
    local largest = 0
    for key in pairs(t) do
        if math.type(key) == 'integer' and key > largest then largest = key end
    end
    return largest
end

local function firstHole(t, length)
    for i = 1, length do
        if t[i] == nil then return i end
    end
end

assert:register('modifier', 'array', function(state, arguments, level)
    if not arguments or arguments.n == 0 then error('No array provided to the array-modifier', level) end
    if type(arguments[1]) ~= 'table' then check.refuse(1, 'array', 'table', type(arguments[1]), level) end
    state.array = arguments[1]
    return state
end)

assert:register('assertion', 'holes', function(state, arguments, level)
    local t, length = rawget(state, 'array'), arguments[1]
    if not t then error('No array set, please use the array modifier to set the array to validate', level) end
    if length ~= nil and type(length) ~= 'number' then
        error(("expected array length to be of type 'number', got: %s"):format(tostring(length)), level)
    end
    local hole = firstHole(t, length or largestIndex(t))
    arguments[1], arguments.n = hole, 1
    return hole ~= nil, {hole, n = hole and 1 or 0}
end, 'assertion.array_holes.positive', 'assertion.array_holes.negative')
