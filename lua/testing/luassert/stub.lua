--[[
Spies that do something else than the function they stand in for.

    local stub = require 'luassert.stub'
    stub(t, 'name')                             does nothing until it is reverted; the table need not have the function
    stub(t, 'name', 1, 2)                       returns 1, 2
    stub(t, 'name', function(...) ... end)      does that instead
    stub(t, 'name').returns(1, 2)               the same said later; also .invokes(f), and .by_default.returns, .by_default.invokes
    stub(t, 'name').on_call_with('a', match._).returns(3)       or .invokes(f): for such arguments; the first that fit count
    stub(sim, 'getJointPosition').returns(0.5)
    assert.stub(t.name).was.called()            all that spies can; t.name:revert() puts the function back
]]

local spy = require 'luassert.spy'
local util = require 'luassert.util'

local stub = {}

-- The two ways to say what a stub does, each of which gives the stub.
local function answers(set, object)
    return {
        returns = function(...)
            local results = table.pack(...)
            set(function() return table.unpack(results, 1, results.n) end)
            return object
        end,
        invokes = function(f)
            if not util.callable(f) then
                error(("bad argument #1 to 'invokes' (function or callable object expected, got %s)"):format(type(f)), 2)
            end
            set(f)
            return object
        end,
    }
end

-- Makes a spy without a table do what it is told.
local function instruct(object)
    local default, cases = object.callback, {}
    function object.callback(...)
        local arguments = table.pack(...)
        local recorded = {vals = arguments, refs = arguments}
        for _, case in ipairs(cases) do
            if spy.matches(recorded, case.arguments) then return case.answer(...) end
        end
        return default(...)
    end
    function object.on_call_with(...)
        local arguments = table.pack(...)
        return answers(function(answer) table.insert(cases, {arguments = arguments, answer = answer}) end, object)
    end
    object.by_default = answers(function(answer) default = answer end, object)
    object.returns, object.invokes = object.by_default.returns, object.by_default.invokes
    return object
end

local function isElement(t, key) return (type(t) == 'table' or type(t) == 'userdata') and key ~= nil end

-- Without a table a stub of its own.
local function new(t, key, ...)
    local object = instruct(spy.new())
    if t ~= nil or key ~= nil then
        if not isElement(t, key) then
            error('stub.new(): Can only create stub on a table key, call with 2 params; table, key', 3)
        end
        if t[key] ~= nil and not util.callable(t[key]) then
            error('stub.new(): The element for which to create a stub must either be callable, or be nil', 3)
        end
        spy.install(object, t, key)
    end
    local first = ...
    if select('#', ...) == 1 and util.callable(first) then return object.invokes(first) end
    return object.returns(...)
end

-- @api table stub = luassert.stub.new(...)
function stub.new(...) return (new(...)) end

return setmetatable(stub, {__call = function(_, ...) return (new(...)) end})
