--[[
Wraps a deprecated function: logs the notice at the first call, then calls the function.
Called as a chunk with the function and the notice.
]]

local f, notice = ...
local SCRIPT_WARNINGS <const> = 430
local told = false

return function(...)
    if not told then
        told = true
        addLog(SCRIPT_WARNINGS, notice)
    end
    return f(...)
end
