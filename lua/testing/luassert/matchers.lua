--[[
The matchers of `luassert.match`.
]]

local assert = require 'luassert.core'
local check = require 'luassert.arguments'
local match = require 'luassert.match'
local util = require 'luassert.util'

local function register(name, callback) assert:register('matcher', name, callback) end

-- A matcher without arguments.
local function about(name, holds)
    register(name, function() return holds end)
end

about('true', function(value) return value == true end)
about('false', function(value) return value == false end)
about('truthy', function(value) return value end)
about('falsy', function(value) return not value end)

for _, kind in ipairs{'boolean', 'number', 'string', 'table', 'nil', 'userdata', 'function', 'thread'} do
    about(kind, function(value) return type(value) == kind end)
end

local function equal(_, arguments, level)
    check.atLeast(1, arguments, 'equals', level)
    return function(value) return value == arguments[1] end
end

register('equal', equal)
register('equals', equal)

register('same', function(_, arguments, level)
    check.atLeast(1, arguments, 'same', level)
    return function(value) return (util.deepcompare(value, arguments[1], true)) end
end)

register('ref', function(_, arguments, level)
    check.atLeast(1, arguments, 'ref', level)
    local object = arguments[1]
    local kind = type(object)
    if kind ~= 'table' and kind ~= 'function' and kind ~= 'thread' and kind ~= 'userdata' then
        check.refuse(1, 'ref', 'object', kind, level)
    end
    return function(value) return rawequal(value, object) end
end)

register('near', function(_, arguments, level)
    check.atLeast(2, arguments, 'near', level)
    local expected = check.number(arguments, 1, 'near', level)
    local tolerance = check.number(arguments, 2, 'near', level)
    return function(value)
        local number = tonumber(value)
        return number and number >= expected - tolerance and number <= expected + tolerance
    end
end)

local function matches(_, arguments, level)
    check.atLeast(1, arguments, 'matches', level)
    local pattern = check.pattern(arguments, 1, 2, 'matches', level)
    return function(value)
        local text = check.text(value)
        return text and check.find(text, pattern, 2) ~= nil
    end
end

register('matches', matches)
register('match', matches)

register('unique', function(_, arguments)
    return function(value) return type(value) == 'table' and util.unique(value, arguments[1] == true) end
end)

-- A matcher made of others: `decide` gets their number, and of how many the value is.
local function compose(name, decide)
    register(name, function(_, arguments, level)
        check.atLeast(1, arguments, name, level)
        for i = 1, arguments.n do
            if not match.is_matcher(arguments[i]) then check.refuse(i, name, 'matcher', type(arguments[i]), level) end
        end
        return function(value)
            local count = 0
            for i = 1, arguments.n do
                if arguments[i](value) then count = count + 1 end
            end
            return decide(count, arguments.n)
        end
    end)
end

compose('all_of', function(count, all) return count == all end)
compose('any_of', function(count) return count > 0 end)
compose('none_of', function(count) return count == 0 end)
