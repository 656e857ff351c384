--[[
Signals, messages and logs for tests. Internal.
]]

local sim = require('sim')

--- Adds the functions to the fixture.
return function(t, native)
    -- @api any value = swanilda.test.signal(string name, ...)
    function t.signal(name, ...)
        if select('#', ...) == 0 then
            return sim.getFloatSignal(name) or sim.getInt32Signal(name) or sim.getStringSignal(name)
        end
        local value = ...
        if value == false or value == nil then
            for _, kind in ipairs { 'Float', 'Int32', 'String' } do sim['clear' .. kind .. 'Signal'](name) end
        elseif math.type(value) == 'integer' then
            sim.setInt32Signal(name, value)
        elseif math.type(value) == 'float' then
            sim.setFloatSignal(name, value)
        else
            sim.setStringSignal(name, value)
        end
    end

    -- @api swanilda.test.message(any data, table options = nil)
    function t.message(data, options) return sim.broadcastMsg(data, options) end

    function t.lines() return native.lines(0, true) end

    -- @api table prints = swanilda.test.prints()
    function t.prints()
        local texts = {}
        for _, line in ipairs(t.lines()) do
            if line.level == 'print' then texts[#texts + 1] = line.text end
        end
        return texts
    end

    -- @api table lines = swanilda.test.logs(string pattern = nil)
    function t.logs(pattern)
        local found = {}
        for _, line in ipairs(native.lines()) do
            if line.origin and (not pattern or line.text:find(pattern)) then found[#found + 1] = line end
        end
        return found
    end
end
