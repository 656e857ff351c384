--[[
Global functions of V-REP that were never members of sim, and do little or nothing in CoppeliaSim. The table old_names.tsv has the global names.

Those that check their arguments are native.
]]

local sim = ...
local M = {}

local warned = {}

local function warn(name, reason)
    local line = debug.getinfo(3, 'l')
    addLog(sim.verbosity_scriptwarnings, ("%d: in '%s' %s"):format(line and line.currentline or -1, name, reason))
end

--- Does nothing but warn: the default main script calls simulation scripts.
-- @api sim._simHandleChildScript()
function M._simHandleChildScript()
    if not warned.simHandleChildScript then
        warned.simHandleChildScript = true
        addLog(sim.verbosity_errors, 'simHandleChildScript is no longer supported. It was replaced by sim.handleSimulationScripts: adjust the script by hand.')
    end
    warn('simHandleChildScript', 'this function is deprecated, use simHandleSimulationScripts instead.')
end

--- Does nothing.
-- @api sim._simNothing()
function M._simNothing() end

--- Does nothing but warn.
-- @api sim._simHandleTracing()
function M._simHandleTracing() warn('simHandleTracing', 'this function has no effect any more.') end

--- Does nothing but warn.
-- @api sim._simResetTracing()
function M._simResetTracing() warn('simResetTracing', 'this function has no effect any more.') end

--- Nothing to lock without a display.
-- @api int result = sim._simLockInterface()
-- @return result -1
function M._simLockInterface() return -1 end

--- Number of this program among several in one window; there is one.
-- @api int index = sim._simGetInstanceIndex()
-- @return index 0
function M._simGetInstanceIndex() return 0 end

--- Inverse of a matrix.
-- @api float[12] inverse = sim._simGetInvertedMatrix(float[12] matrix)
-- @param matrix the first three rows
-- @return inverse in a new table
function M._simGetInvertedMatrix(matrix)
    local inverse = table.move(matrix, 1, #matrix, 1, {})
    sim.invertMatrix(inverse)
    return inverse
end

--- Whether the script is a thread of V-REP.
-- @api int result = sim.isScriptExecutionThreaded()
-- @return result 0: threads are coroutines
function M.isScriptExecutionThreaded() return 0 end

--- Whether the code runs in a thread of V-REP.
-- @api int result = sim.isScriptRunningInThread()
-- @return result 0: threads are coroutines
function M.isScriptRunningInThread() return 0 end

--- Sets where a thread of V-REP is resumed in the next steps. Those of old scenes are coroutines, which are resumed in actuation.
-- @api int result = sim.setThreadResumeLocation(int location, int order)
-- @param location any
-- @param order any
-- @return result 0
function M.setThreadResumeLocation(location, order) return 0 end

return M
