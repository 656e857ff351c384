--[[
The thread of a script: its function sysCall_thread, as a coroutine that hooks resume. Loaded for scripts that have one.
]]

local M = {}

local function resume()
    local thread = __coroutine__
    if not thread or coroutine.status(thread) == 'dead' then return end
    -- The original takes any true value here, also one that was yielded on purpose, for an error message.
    local _, message = coroutine.resume(thread)
    if message then error(debug.traceback(thread, message), 0) end
end

function M.begin()
    __coroutine__ = coroutine.create(sysCall_thread)
    registerScriptFuncHook('sysCall_actuation', resume, true)
    registerScriptFuncHook('sysCall_nonSimulation', resume, true)
end

return M
