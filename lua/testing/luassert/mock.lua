--[[
Spies or stubs for all functions of a table and of the tables in it.

    local mock = require 'luassert.mock'
    local m = mock(t)               spies in t itself, which is the result
    local m = mock(t, true, ...)    stubs that do nothing, or what stub(t, name, ...) does
    assert.spy(m.name).was.called()
    mock.clear(m), mock.revert(m)
]]

local spy = require 'luassert.spy'
local stub = require 'luassert.stub'

local mock = {}

-- Calls `visit(t, key, value)` for each element of a table and of the tables in it. Spies count as elements.
local function walk(t, visit, met)
    if type(t) ~= 'table' or spy.is_spy(t) or met[t] then return end
    met[t] = true
    local elements = {}
    for key, value in pairs(t) do elements[#elements + 1] = {key, value} end
    for _, element in ipairs(elements) do
        visit(t, element[1], element[2])
        walk(element[2], visit, met)
    end
end

-- @api table mock = luassert.mock.new(table object, bool doStubs = false, ...)
function mock.new(object, doStubs, ...)
    local answer = table.pack(...)
    local function replace(t, key, value)
        if type(value) ~= 'function' then return end
        if doStubs then stub(t, key, table.unpack(answer, 1, answer.n)) else spy.on(t, key) end
    end
    if type(object) == 'function' then
        if not doStubs then return spy.new(object) end
        return stub(nil, nil, ...)
    end
    walk(object, replace, {})
    return object
end

local function forSpies(object, f)
    if spy.is_spy(object) then f(object) end
    walk(object, function(_, _, value)
        if spy.is_spy(value) then f(value) end
    end, {})
    return object
end

-- @api table object = luassert.mock.clear(table object)
function mock.clear(object)
    return forSpies(object, function(s) s:clear() end)
end

-- @api table object = luassert.mock.revert(table object)
function mock.revert(object)
    return forSpies(object, function(s) s:revert() end)
end

return setmetatable(mock, {__call = function(_, ...) return mock.new(...) end})
