--[[
Assertions about functions that raise errors.
]]

local assert = require 'luassert.core'
local check = require 'luassert.arguments'
local util = require 'luassert.util'

-- Calls the function. Gives whether it raised, and the error, a text without its position, or the first result.
local function run(f)
    local succeeded, value = pcall(f)
    if not succeeded and type(value) == 'string' then value = value:match('^.-:%d+: (.*)$') or value end
    return not succeeded, value
end

-- Puts what was caught, for the message, and what is to be returned in place of the function.
local function report(arguments, hasRaised, value)
    local given = table.move(arguments, 1, arguments.n, 1, {n = arguments.n})
    given[1] = value
    arguments[1] = value
    arguments.nofmt = {}
    if not hasRaised then arguments[1], arguments.nofmt[1] = '(no error)', true end
    if arguments[2] == nil then arguments[2], arguments.nofmt[2] = '(error)', true end
    arguments.n = math.max(arguments.n, 2)
    return given
end

local function isExpected(expected, caught)
    if expected == nil then return true end
    if type(expected) == 'string' and util.hastostring(caught) then return tostring(caught) == expected end
    if type(expected) == 'number' and type(caught) == 'string' then return caught == tostring(expected) end
    return (util.deepcompare(expected, caught, true))
end

local function hasError(state, arguments, level)
    local f, expected = check.callable(arguments, 'error', level), arguments[2]
    check.message(state, arguments[3])
    local hasRaised, value = run(f)
    local given = report(arguments, hasRaised, value)
    return hasRaised and isExpected(expected, value), given
end

local function errorMatches(state, arguments, level)
    check.atLeast(2, arguments, 'error_matches', level)
    local f = check.callable(arguments, 'error_matches', level)
    local pattern, message = check.pattern(arguments, 2, 3, 'error_matches', level)
    check.message(state, message)
    local hasRaised, value = run(f)
    local given = report(arguments, hasRaised, value)
    local text = hasRaised and check.text(value)
    local captures = text and check.find(text, pattern, level)
    if not captures then return false, given end
    return true, captures
end

for _, name in ipairs{'error', 'errors'} do
    assert:register('assertion', name, hasError, 'assertion.error.positive', 'assertion.error.negative')
end
for _, name in ipairs{'error_matches', 'error_match', 'matches_error', 'match_error'} do
    assert:register('assertion', name, errorMatches, 'assertion.error.positive', 'assertion.error.negative')
end
