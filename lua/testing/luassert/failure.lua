--[[
How an assertion that does not hold ends its caller: with a text, or under a test runner with a failure, so that the runner can tell it
from an error of the code under test.
]]

local formatters = require 'luassert.formatters'

local failure = {}

local objects = false

-- `__type` is what runners of busted suites look at.
local METATABLE = {
    __type = 'failure',
    __tostring = function(self)
        return type(self.message) == 'string' and self.message or formatters.format{self.message, n = 1}[1]
    end,
}

--- Whether failures are raised as tables with a field `message`, which `failure.is` knows; texts otherwise.
function failure.raise_objects(yes) objects = yes end

function failure.is(value) return type(value) == 'table' and getmetatable(value) == METATABLE end

-- Where the function at that level stands, as errors begin.
local function position(level)
    local info = debug.getinfo(level + 1, 'Sl')
    if not info or info.currentline <= 0 then return '' end
    return ('%s:%d: '):format(info.short_src, info.currentline)
end

--- Raises the failure; the level counts as that of `error`, from the function that calls this one.
function failure.raise(message, level)
    if type(message) == 'string' then message = position(level + 1) .. message end
    if objects then message = setmetatable({message = message}, METATABLE) end
    error(message, 0)
end

return failure
