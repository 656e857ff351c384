--[[
Parameters and results of a scene that `swanilda batch` runs many times.

    batch.param(name, default)     the value for this run, as a number if possible; the default if it is not set
    batch.result(name, value)      a number, a text or a truth value for the table; the last one counts

Both are named parameters (sim.getNamedStringParam, sim.setNamedStringParam), results with `result.` before their name, so a scene also works
without this file, for example in CoppeliaSim. Outside a batch, `-D name=value` sets parameters.
]]

local sim = require('sim')

local batch = {}

-- @api any value = swanilda.batch.param(string name, any default = nil)
function batch.param(name, default)
    local text = sim.getNamedStringParam(name)
    if not text or text == '' then return default end
    return tonumber(text) or text
end

-- All digits that make the number, and no more.
local function digits(value)
    for count = 15, 17 do
        local text = ('%.' .. count .. 'g'):format(value)
        if tonumber(text) == value then return text end
    end
    return tostring(value)
end

-- @api swanilda.batch.result(string name, any value)
function batch.result(name, value)
    sim.setNamedStringParam('result.' .. name, math.type(value) == 'float' and digits(value) or tostring(value))
end

return batch
