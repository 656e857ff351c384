--[[
Wraps a deprecated function: logs the notice at the first call, then calls the function.
Called as a chunk with the function, the notice and the members of its file. Files with warnsOnceForAll are warned of once:
at the first call of any of their functions.
]]

local f, notice, members = ...
local SCRIPT_WARNINGS <const> = 430
local state = members.warnsOnceForAll and members or {}

return function(...)
    if not state.hasWarned then
        state.hasWarned = true
        addLog(SCRIPT_WARNINGS, notice)
    end
    return f(...)
end
