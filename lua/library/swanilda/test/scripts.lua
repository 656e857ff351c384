--[[
The scripts of a scene as tests see them: calls, variables, and functions that tests put in place of theirs. Internal.
]]

local sim = require('sim')

local Script = {}
Script.__index = Script

-- What scripts call when a function of theirs is wrapped: by number, with the script that calls.
local wrappers = {}
function _swanilda_test_wrapper(number, ...) return wrappers[number](...) end

function Script:call(name, ...) return sim.callScriptFunction(name, self.handle, ...) end

function Script:run(code)
    local results = table.pack(sim.executeScriptString(code, self.handle))
    if results[1] ~= 0 then error(("script %d: %s"):format(self.handle, tostring(results[2])), 2) end
    return table.unpack(results, 2, results.n)
end

function Script:get(expression) return self:run('return ' .. expression) end

function Script:set(name, value)
    self:run('function _swanilda_test_set(value) ' .. name .. ' = value end')
    self:call('_swanilda_test_set', value)
end

local WRAP = [[
    local number, test = %d, %d
    local original = %s
    _swanilda_test_originals = _swanilda_test_originals or {}
    _swanilda_test_originals[number] = original
    function _swanilda_test_call(number, ...) return _swanilda_test_originals[number](...) end
    %s = function(...) return sim.callScriptFunction('_swanilda_test_wrapper', test, number, ...) end
]]

function Script:wrap(name, fn)
    local number = #wrappers + 1
    local function call(...) return self:call('_swanilda_test_call', number, ...) end
    wrappers[number] = function(...) return fn(call, ...) end
    self:run(WRAP:format(number, sim_script_handle, name, name))
    self.wrapped[name] = number
end

function Script:unwrap(name)
    local number = self.wrapped[name]
    if not number then error(("'%s' is not wrapped."):format(name), 2) end
    self:run(('%s = _swanilda_test_originals[%d]'):format(name, number))
    self.wrapped[name] = nil
end

function Script:stub(name, ...)
    local results = table.pack(...)
    local watched = require('luassert.spy').new(function() return table.unpack(results, 1, results.n) end)
    self:wrap(name, function(_, ...) return watched(...) end)
    return watched
end

function Script:spy(name)
    local original
    local watched = require('luassert.spy').new(function(...) return original(...) end)
    self:wrap(name, function(call, ...)
        original = call
        return watched(...)
    end)
    return watched
end

return Script
