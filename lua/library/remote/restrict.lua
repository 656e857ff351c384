--[[
Restricts remote clients if `execUnsafeExt` is false: no files, no programs, no code passed as text. For the add-ons that serve them.

Removes these functions from the Lua state. It is not a sandbox: a client may create a script in the scene, and scripts may use
files.
]]

local sim = require('sim')

local REMOVED <const> = {
    _G = {'load', 'loadfile', 'loadstring', 'dofile'},
    io = {'open', 'popen', 'lines', 'input', 'output', 'tmpfile'},
    os = {'execute', 'remove', 'rename', 'tmpname'},
    package = {'loadlib'},
    debug = {
        'debug', 'getlocal', 'getregistry', 'getupvalue', 'getuservalue', 'setlocal', 'setmetatable', 'setupvalue',
        'setuservalue', 'sethook', 'upvalueid', 'upvaluejoin',
    },
}

for library, names in pairs(REMOVED) do
    for _, name in ipairs(names) do _G[library][name] = nil end
end

local HIDDEN <const> = {'executeScriptString', 'launchExecutable'}

for _, name in ipairs(HIDDEN) do
    sim[name] = false -- with nil the member would come back when it is asked for
    _G['sim' .. name:sub(1, 1):upper() .. name:sub(2)] = false -- its older name
end

-- Modules about files and programs.
for _, name in ipairs{'lfs', 'lfsx', 'simSubprocess'} do
    package.preload[name] = function() error('not for remote clients (--no-unsafe).', 0) end
end

-- What a client may not reach through another script: a name, or all of a library.
local FORBIDDEN <const> = {
    _evalExec = true, _evalExecRet = true, load = true, loadfile = true, loadstring = true, dofile = true,
    require = true, io = true, os = true, package = true, debug = true, lfs = true, simSubprocess = true,
}

local callScriptFunction = sim.callScriptFunction

local function allowed(value)
    local name = isbuffer(value) and tostring(value) or value
    return type(name) == 'string' and FORBIDDEN[name:match('^[^.]*')] and 'FORBIDDEN' or value
end

-- The name may come first or second.
function sim.callScriptFunction(first, second, ...) return callScriptFunction(allowed(first), allowed(second), ...) end

simCallScriptFunction = sim.callScriptFunction
