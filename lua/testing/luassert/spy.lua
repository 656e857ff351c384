--[[
Functions that remember how they were called.

    local spy = require 'luassert.spy'
    local s = spy.new(f)            a spy that calls f; s(...) is the call
    local s = spy.on(t, 'name')     puts the spy into the table, until s:revert(); also for functions of `sim`
    assert.spy(s).was.called()      at least once; called(n) n times; was_not.called() never
    assert.spy(s).was.called_with(1, {2}, match.is_string())        in some call; tables as they were at the call
    assert.spy(s).has.returned_with(...)
    assert.spy(s).was.called_at_least(n)        also called_at_most, called_more_than, called_less_than
    s.calls[i].vals, s.calls[i].refs            arguments as they were, and the very ones; their number is in `n`
    s.returnvals[i].vals                        results
    s:clear()                       forgets the calls
    spy.is_spy(x)

A spy stands in for a function in the script that made it; other scripts have their own tables.
]]

local assert = require 'luassert.core'
local check = require 'luassert.arguments'
local formatters = require 'luassert.formatters'
local util = require 'luassert.util'

local spy = {}

local Spy = {}
Spy.__index = Spy

-- Arguments or results as they are now, and by reference.
local function record(values)
    local copies = {n = values.n}
    for i = 1, values.n do copies[i] = util.deepcopy(values[i]) end
    return {vals = copies, refs = values}
end

function Spy:__call(...)
    local arguments = table.pack(...)
    table.insert(self.calls, record(arguments))
    local results = table.pack(self.callback(...))
    table.insert(self.returnvals, record(results))
    return table.unpack(results, 1, results.n)
end

local function hasValue(expected, recorded, index)
    local value = recorded.vals[index]
    if getmetatable(expected) == formatters.Matcher then
        return expected(expected.name == 'ref' and recorded.refs[index] or value)
    end
    return (util.deepcompare(value, expected))
end

-- Whether recorded values are what a list of values and matchers says.
-- @api bool result = luassert.spy.matches(table recorded, table expected)
function spy.matches(recorded, expected)
    local count = expected.n or #expected
    if recorded.vals.n ~= count then return false end
    for i = 1, count do
        if not hasValue(expected[i], recorded, i) then return false end
    end
    return true
end

-- Whether some record matches, and the last that does; else the last of all.
local function find(records, expected)
    for i = #records, 1, -1 do
        if spy.matches(records[i], expected) then return true, records[i].vals end
    end
    local last = records[#records]
    return false, last and last.vals
end

local function areEqual(count, times) return count == times end
local function isPositive(count) return count > 0 end

-- Whether it was called that often, or at all; and how often it was.
function Spy:called(times, compare)
    local count = #self.calls
    compare = compare or (times and areEqual or isPositive)
    return compare(count, times), count
end

function Spy:called_with(arguments) return find(self.calls, arguments) end
function Spy:returned_with(results) return find(self.returnvals, results) end

function Spy:clear()
    self.calls, self.returnvals = {}, {}
    return self
end

-- Puts back what the spy stands in for.
function Spy:revert()
    local t, key = self.target_table, self.target_key
    if t ~= nil and not self.is_reverted then
        self.is_reverted = true
        t[key] = self.original
    end
end

local function nothing() end

-- A spy outside of any table. `level` is that of the caller to blame.
local function new(callback, level)
    if callback ~= nil and not util.callable(callback) then
        error(("Cannot spy on type '%s', only on functions or callable elements"):format(type(callback)), level + 1)
    end
    return setmetatable({calls = {}, returnvals = {}, callback = callback or nothing}, Spy)
end

-- @api table spy = luassert.spy.new(func callback = nil)
function spy.new(callback) return (new(callback, 2)) end

-- @api bool result = luassert.spy.is_spy(any value)
function spy.is_spy(value) return type(value) == 'table' and getmetatable(value) == Spy end

-- Puts the spy in place of an element. What the table had only through its metatable is not left in it by `revert`.
-- @api table spy = luassert.spy.install(table new, table t, any key)
function spy.install(new, t, key)
    local original = t[key]
    local isInherited = type(t) == 'table' and rawget(t, key) == nil
    t[key] = new
    isInherited = isInherited and rawget(t, key) ~= nil
    new.target_table, new.target_key = t, key
    new.original = not isInherited and original or nil
    assert:add_spy(new)
    return new
end

-- @api table spy = luassert.spy.on(table t, any key)
function spy.on(t, key)
    if type(t) ~= 'table' and type(t) ~= 'userdata' then
        error(("bad argument #1 to 'on' (table expected, got %s)"):format(type(t)), 2)
    end
    return spy.install(new(t[key], 2), t, key)
end

local function choose(state, arguments, level)
    local chosen = arguments and arguments[1]
    if type(chosen) == 'function' then
        error("When calling 'spy(aspy)', 'aspy' must not be the original function, but the spy function replacing the original",
            level)
    end
    state.spy = chosen
    return state
end

assert:register('modifier', 'spy', choose)
assert:register('modifier', 'stub', choose)

local function chosen(state, name, level)
    local found = rawget(state, 'spy')
    if not spy.is_spy(found) then error(("'%s' must be chained after 'spy(aspy)'"):format(name), level + 1) end
    return found
end

-- Registers an assertion about the chosen spy.
local function register(name, holds)
    local function callback(state, arguments, level)
        local given = table.move(arguments, 1, arguments.n, 1, {n = arguments.n})
        return holds(chosen(state, name, level), arguments, state, level + 1), given
    end
    local key = 'assertion.' .. name
    assert:register('assertion', name, callback, key .. '.positive', key .. '.negative')
end

local function report(arguments, expected, found)
    arguments[1], arguments[2], arguments.n = expected, found, 2
end

register('called', function(s, arguments, state)
    local times = arguments[1]
    -- Never is zero times.
    if times == nil and not state.mod then times, state.mod = 0, true end
    local holds, count = s:called(times)
    report(arguments, times or '>0', count)
    arguments.nofmt = {true, true}
    return holds
end)

local function registerCount(name, compare)
    register(name, function(s, arguments, _, level)
        local times = arguments[1]
        if type(times) ~= 'number' then check.refuse(1, name, 'number', type(times), level) end
        local holds, count = s:called(times, compare)
        report(arguments, times, count)
        arguments.nofmt = {true, true}
        return holds
    end)
end

registerCount('called_at_least', function(count, times) return count >= times end)
registerCount('called_at_most', function(count, times) return count <= times end)
registerCount('called_more_than', function(count, times) return count > times end)
registerCount('called_less_than', function(count, times) return count < times end)

local function registerValues(name)
    register(name, function(s, arguments)
        local expected = table.move(arguments, 1, arguments.n, 1, {n = arguments.n})
        local holds, found = s[name](s, expected)
        report(arguments, found and formatters.values(found), formatters.values(expected))
        return holds
    end)
end

registerValues('called_with')
registerValues('returned_with')

return setmetatable(spy, {__call = function(_, callback) return (new(callback, 2)) end})
