--[[
The scripts of a scene as tests see them: calls, variables, and functions that tests put in place of theirs. Internal.
]]

local sim = require('sim')

local Script = {}
Script.__index = Script

function Script:__tostring() return sim.getObjectAlias(self.handle, 2) end

-- What scripts call when a function of theirs is wrapped: by number, with the script that calls.
local wrappers = {}
function _swanilda_test_wrapper(number, ...) return wrappers[number](...) end

function Script:call(name, ...) return sim.callScriptFunction(name, self.handle, ...) end

local function isPython(script)
    return sim.getStringProperty(script.handle, 'language', {noError = true}) == 'python'
end

function Script:run(code)
    -- From the last @ on a string is the name of a language.
    if isPython(self) then code = code .. '@python' end
    local results = table.pack(sim.executeScriptString(code, self.handle))
    if results[1] ~= 0 then error(("script %d: %s"):format(self.handle, tostring(results[2])), 2) end
    return table.unpack(results, 2, results.n)
end

function Script:get(expression) return self:run(isPython(self) and expression or 'return ' .. expression) end

local SET_IN_PYTHON = [[
def _swanilda_test_set(value):
    scope = globals()
    scope['_swanilda_test_value'] = value
    exec('%s = _swanilda_test_value', scope)
]]

function Script:set(name, value)
    if isPython(self) then
        self:run(SET_IN_PYTHON:format(name))
        return self:call('_swanilda_test_set', value)
    end
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

local WRAP_IN_PYTHON = [[
def _swanilda_test_call(number, *args):
    return _swanilda_test_originals[number](*args)

def _swanilda_test_wrapped(number, test, original):
    globals().setdefault('_swanilda_test_originals', {})[number] = original
    def wrapper(*args):
        results = require('sim').callScriptFunction('_swanilda_test_wrapper', test, number, *args)
        return list(results) if isinstance(results, tuple) else results
    return wrapper

%s = _swanilda_test_wrapped(%d, %d, %s)
]]

-- The code that puts a wrapper in place of a function.
local function wrapping(script, number, name)
    if isPython(script) then return WRAP_IN_PYTHON:format(name, number, sim_script_handle, name) end
    return WRAP:format(number, sim_script_handle, name, name)
end

function Script:wrap(name, fn)
    local number = #wrappers + 1
    local function call(...) return self:call('_swanilda_test_call', number, ...) end
    wrappers[number] = function(...) return fn(call, ...) end
    self:run(wrapping(self, number, name))
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
