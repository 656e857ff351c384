--[[
Log lines with a level. Loading the module makes log and setloglevel global.

A level is a number of sim.verbosity_*, or 'error', 'warning', 'info', 'debug', 'trace'. Lines beyond the level of setloglevel are
dropped ('info' at first); the rest go to sim.addLog, where the verbosity of the script decides.
]]

local sim = _quietRequire 'sim'

local LEVELS = {
    error = sim.verbosity_scripterrors, warning = sim.verbosity_scriptwarnings, info = sim.verbosity_scriptinfos,
    debug = sim.verbosity_debug, trace = sim.verbosity_trace,
}

local logger = {levels = LEVELS}
local threshold = LEVELS.info

local function levelOf(name)
    local level = math.tointeger(name) or LEVELS[type(name) == 'string' and name:lower()]
    if not level then error('unknown log level: ' .. tostring(name), 3) end
    return level
end

--- Logs a formatted text at a level.
-- @api logger.log(any level, any format, ...)
function logger.log(level, format, ...)
    local number = levelOf(level)
    if number > threshold then return end
    local text = tostring(format)
    if select('#', ...) > 0 then text = text:format(...) end
    sim.addLog(number, text)
end

--- Drops texts beyond a level.
-- @api logger.setloglevel(any level)
function logger.setloglevel(level) threshold = levelOf(level) end

log, setloglevel = logger.log, logger.setloglevel

return logger
