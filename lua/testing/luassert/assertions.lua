--[[
Assertions about values: equality, types, truth, patterns.
]]

local assert = require 'luassert.core'
local check = require 'luassert.arguments'
local util = require 'luassert.util'

local function register(name, callback, key)
    assert:register('assertion', name, callback, ('assertion.%s.positive'):format(key), ('assertion.%s.negative'):format(key))
end

-- Callers name first what they expect, messages what was passed. Gives the arguments as they were.
local function swap(arguments)
    local given = table.move(arguments, 1, arguments.n, 1, {n = arguments.n})
    arguments[1], arguments[2] = given[2], given[1]
    return given
end

local function equal(state, arguments, level)
    check.atLeast(2, arguments, 'equals', level)
    check.message(state, arguments[3])
    local given = swap(arguments)
    return given[1] == given[2], given
end

register('equal', equal, 'equals')
register('equals', equal, 'equals')

register('same', function(state, arguments, level)
    check.atLeast(2, arguments, 'same', level)
    check.message(state, arguments[3])
    local given = swap(arguments)
    local isSame, crumbs = util.deepcompare(given[1], given[2], true)
    arguments.fmtargs = {{crumbs = crumbs}, {crumbs = crumbs}}
    return isSame, given
end, 'same')

register('near', function(state, arguments, level)
    check.atLeast(3, arguments, 'near', level)
    local expected = check.number(arguments, 1, 'near', level)
    local passed = check.number(arguments, 2, 'near', level)
    local tolerance = check.number(arguments, 3, 'near', level)
    check.message(state, arguments[4])
    local given = swap(arguments)
    arguments.nofmt = {[3] = true}
    return passed >= expected - tolerance and passed <= expected + tolerance, given
end, 'near')

register('unique', function(state, arguments, level)
    local list, deep, message = arguments[1], arguments[2], arguments[3]
    if type(list) ~= 'table' then check.refuse(1, 'unique', 'table', type(list), level) end
    local hasMessage = deep ~= nil and type(deep) ~= 'boolean'
    check.message(state, hasMessage and deep or message)
    return util.unique(list, deep == true)
end, 'unique')

local function matches(state, arguments, level)
    check.atLeast(2, arguments, 'matches', level)
    local pattern, message = check.pattern(arguments, 1, 3, 'matches', level)
    check.message(state, message)
    local text = check.text(arguments[2])
    if not text then
        check.refuse(2, 'matches', 'string or object convertible to a string', check.shown(arguments[2]), level)
    end
    swap(arguments)
    local captures = check.find(text, pattern, level)
    return captures ~= nil, captures or {}
end

register('matches', matches, 'matches')
register('match', matches, 'matches')

register('truthy', function(state, arguments, level)
    check.atLeast(1, arguments, 'truthy', level)
    check.message(state, arguments[2])
    return arguments[1]
end, 'truthy')

register('falsy', function(state, arguments, level)
    check.atLeast(1, arguments, 'falsy', level)
    check.message(state, arguments[2])
    return not arguments[1]
end, 'falsy')

-- An assertion about the first argument alone, which says what it expects.
local function about(name, expected, isText, holds)
    register(name, function(state, arguments)
        check.message(state, arguments[2])
        local given = table.move(arguments, 1, arguments.n, 1, {n = arguments.n})
        arguments[2], arguments.n = expected, math.max(arguments.n, 2)
        arguments.nofmt = {[2] = isText}
        return holds(arguments[1]), given
    end, 'same')
end

about('true', true, false, function(value) return value == true end)
about('false', false, false, function(value) return value == false end)

-- How many values a call gave: the expected number, then the values.
register('returned_arguments', function(_, arguments)
    local given = table.move(arguments, 1, arguments.n, 1, {n = arguments.n})
    local expected, count = arguments[1], arguments.n - 1
    arguments[2], arguments.n = count, 2
    arguments.nofmt = {true, true}
    return expected == count, given
end, 'returned_arguments')

for _, kind in ipairs{'boolean', 'number', 'string', 'table', 'nil', 'userdata', 'function', 'thread'} do
    about(kind, 'type ' .. kind, true, function(value) return type(value) == kind end)
end
