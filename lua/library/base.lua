--[[
Bootstrap of a fresh Lua state; runs once, before any user code.

Does: the wrapped standard functions (require, pcall, tonumber, assert, string.*), buffers, the thread of a script
(global sysCall_thread), and cheap stand-ins for everything a script may use but usually does not.
Does not: hold any of those other functions (swanilda/display.lua, functional.lua, ...), nor the sim table.

Every script runs this file: each closure and table here costs memory in each of them.
]]

local rawrequire, rawpcall, rawtonumber = require, pcall, tonumber
local type, error, select, unpack_ = type, error, select, table.unpack
local rawget, getmetatable, setmetatable = rawget, getmetatable, setmetatable
local setYieldAllowed, usedModule = setYieldAllowed, _usedModule

-- io.write and print go to the same place: without a buffer of its own, what io.write writes stays in order.
io.stdout:setvbuf('no')

local EXPLICIT_OFF = 'implicit loading of modules has been disabled because one known module (%s) was loaded explicitly.'
local WARNING <const> = 430 -- sim.verbosity_scriptwarnings; the sim table is not loaded yet

---------------------------------------------------------------- protected calls and errors

-- Trailing nils get lost in the original because it packs the results in a table; scripts can observe that.
local function unprotect(ok, ...)
    setYieldAllowed(true)
    local n = select('#', ...)
    if n == 0 or n == 1 and (...) == nil then return ok end
    if n == 1 then return ok, ... end
    local results = {...}
    return ok, unpack_(results, 1, #results)
end

function pcall(...)
    setYieldAllowed(false)
    return unprotect(rawpcall(...))
end

function assert(value, ...)
    if value then return value, ... end
    local message = ...
    error(message == nil and 'assertion failed!' or message, 2)
end

---------------------------------------------------------------- buffers

local Buffer = {__index = string}

local function raw(value)
    if type(value) == 'table' and getmetatable(value) == Buffer then return rawget(value, '__buff__') end
    return value
end

local function newBuffer(bytes) return setmetatable({__buff__ = bytes}, Buffer) end

function Buffer.__len(b) return #rawget(b, '__buff__') end
function Buffer.__eq(a, b) return raw(a) == raw(b) end
function Buffer.__concat(a, b) return newBuffer(raw(a) .. raw(b)) end
function Buffer.__tostring(b) return rawget(b, '__buff__') end
function Buffer.__isbuffer() return true end
_setBufferMetatable(Buffer)

function isbuffer(value) return type(value) == 'table' and getmetatable(value) == Buffer end

function tobuffer(value)
    if type(value) == 'table' and getmetatable(value) == Buffer then return value end
    return newBuffer(type(value) == 'string' and value or tostring(value))
end

-- The wrapper of the original drops the base; tonumber('10', 2) is 10 in every script.
function tonumber(value)
    if type(value) == 'table' then value = raw(value) end
    return rawtonumber(value)
end

-- Functions of the string library take buffers wherever they take a string to look into.
do
    local function wrapSubject(name)
        local f = string[name]
        string[name] = function(s, a, b, c)
            if type(s) == 'table' then s = raw(s) end
            return f(s, a, b, c)
        end
    end
    local find, gmatch, gsub, match, rep = string.find, string.gmatch, string.gsub, string.match, string.rep
    local len, sub, byte, unpack = string.len, string.sub, string.byte, string.unpack
    for _, name in ipairs{'find', 'gmatch', 'gsub', 'match', 'rep', 'lower', 'upper', 'reverse'} do wrapSubject(name) end
    function string.len(s) return len(type(s) == 'table' and raw(s) or s) end
    function string.sub(s, i, j) return sub(type(s) == 'table' and raw(s) or s, i, j) end
    function string.byte(s, i, j) return byte(type(s) == 'table' and raw(s) or s, i, j) end
    function string.unpack(format, s, i) return unpack(format, type(s) == 'table' and raw(s) or s, i or 1) end
end

---------------------------------------------------------------- modules

-- Loads a module of the simulator itself, without the side effects of a require written by the user.
local function quietRequire(name)
    setYieldAllowed(false)
    local ok, module = rawpcall(rawrequire, name)
    setYieldAllowed(true)
    if not ok then error(module, 0) end
    return module
end

local KNOWN = {
    'sim', 'simIK', 'simUI', 'simGeom', 'simMujoco', 'simAssimp', 'simBubble', 'simCHAI3D', 'simMTB', 'simOMPL',
    'simOpenMesh', 'simQHull', 'simRRS1', 'simSDF', 'simSubprocess', 'simSurfRec', 'simURDF', 'simVision', 'simWS',
    'simZMQ', 'simIM', 'simEigen', 'simIGL', 'simICP', 'simROS', 'simROS2',
}
local implicit -- name of a module that was loaded by using its global without require
local loadingImplicitly = false

local function loadImplicitly(proxy)
    local name = rawget(proxy, 1)
    loadingImplicitly = true
    local ok, module = rawpcall(quietRequire, name)
    loadingImplicitly = false
    if not ok then error(module, 0) end
    if rawget(_G, name) == proxy then
        _G[name] = module
        implicit = name
        usedModule(name, true)
        addLog(WARNING, "module '" .. name .. "' was implicitly loaded.")
    end
    return module
end

local Proxy = {__newindex = function(proxy, key, value) loadImplicitly(proxy)[key] = value end}

function Proxy.__index(proxy, key)
    if key == 'registerScriptFuncHook' and rawget(proxy, 1) == 'sim' then return registerScriptFuncHook end
    return loadImplicitly(proxy)[key]
end

local proxied = {}
for i = 1, #KNOWN do
    local name = KNOWN[i]
    proxied[name] = true
    _G[name] = setmetatable({name}, Proxy)
end
KNOWN = nil

-- Its plugin made it a global of all scripts, which never required it.
simRemoteApi = setmetatable({}, {
    __index = function(proxy, key)
        local module = quietRequire('simRemoteApi')
        if rawget(_G, 'simRemoteApi') == proxy then simRemoteApi = module end
        return module[key]
    end,
})

local function removeProxies(name)
    for global in pairs(proxied) do
        local value = rawget(_G, global)
        if type(value) == 'table' and getmetatable(value) == Proxy then _G[global] = nil end
    end
    proxied = nil
    if implicit then addLog(WARNING, EXPLICIT_OFF:format(name)) end
end

function require(name)
    if math.type(name) == 'integer' and package.loaded.sim then return quietRequire('swanilda.modload').fromScript(name) end
    local module = quietRequire(name)
    if proxied and proxied[name] and not loadingImplicitly then removeProxies(name) end
    usedModule(name)
    return module
end

---------------------------------------------------------------- things loaded at first use

local function standIns(module, names)
    local loaded
    local stubs = {}
    local function resolve(name)
        loaded = loaded or quietRequire(module)
        local f = loaded[name]
        if rawget(_G, name) == stubs[name] then _G[name] = f end -- else the script has put its own there
        return f
    end
    for i = 1, #names do
        local name = names[i]
        stubs[name] = function(...) return resolve(name)(...) end
        _G[name] = stubs[name]
    end
end

standIns('swanilda.display', {'print', 'printf', 'printToConsole', 'getAsString', 'getAsDisplayString'})
standIns('functional', {
    'map', 'filter', 'foreach', 'reduce', 'range', 'zip', 'any', 'all', 'sum', 'prod', 'partial', 'apply', 'iter',
    'identity', 'negate', 'reify',
})
standIns('swanilda.console', {
    'help', 'printBytes', 'hexdump', '_evalExec', '_evalExecRet', '_getCompletion', '_getCalltip',
})
standIns('swanilda.plugins', {'loadPlugin', 'unloadPlugin'})
standIns('var', {'getvar', 'setvar', 'getlocals'})
standIns('swanilda.modload', {'import', 'rerequire'})

-- A library of the standard whose extensions are copied in when the first missing name is asked for.
local function extendable(library, module)
    setmetatable(library, {__index = function(_, key)
        setmetatable(library, nil)
        for name, f in pairs(quietRequire(module)) do
            if library[name] == nil then library[name] = f end
        end
        return library[key]
    end})
end

extendable(string, 'stringx')
extendable(table, 'tablex')
extendable(math, 'mathx')
operator = setmetatable({}, {__index = function(t, key) return quietRequire('functional').operator[key] end})

function wrap(original, generator) return generator(original) end

-- Where the original keeps the functions of its interface. Native plugins are in the other table.
_S = setmetatable({}, {__index = function(_, key) return key == 'sim' and quietRequire('sim') or nil end})
sim_plugin_namespaces = {}
loadstring, unpack, quit, exit = load, unpack_, quitSimulator, quitSimulator

-- Lua 5.3 took any number as a seed.
local seed = math.randomseed
function math.randomseed(x, ...)
    if type(x) == 'number' and not math.tointeger(x) then x = x == x and math.abs(x) < 2^62 and math.floor(x) or 0 end
    if x == nil then return seed() end
    return seed(x, ...)
end

-- Scripts up to 4.7 used matrices without asking for them. The names share their functions: every script has them.
local MatrixName = {} -- a metatable, and the key of the name

local function matrixClass(stub)
    local name = rawget(stub, MatrixName)
    if rawget(_G, name) == stub then
        quietRequire('matrix')
        addLog(WARNING, "module 'matrix' was implicitly loaded.")
        addLog(WARNING, '"matrix" module is deprecated.')
    end
    return _G[name]
end

function MatrixName.__index(stub, key) return matrixClass(stub)[key] end
function MatrixName.__call(stub, ...) return matrixClass(stub)(...) end
for _, name in ipairs {'Matrix', 'Vector', 'Vector3', 'Vector4', 'Vector7', 'Matrix3x3', 'Matrix4x4'} do
    _G[name] = setmetatable({[MatrixName] = name}, MatrixName)
end

---------------------------------------------------------------- the thread of a script

local function resumeThread()
    local thread = __coroutine__
    if not thread or coroutine.status(thread) == 'dead' then return end
    -- The original takes any true value here, also one that was yielded on purpose, for an error message.
    local _, message = coroutine.resume(thread)
    if message then error(debug.traceback(thread, message), 0) end
end

registerScriptFuncHook('sysCall_init', function()
    if type(sysCall_thread) ~= 'function' then return end
    __coroutine__ = coroutine.create(sysCall_thread)
    registerScriptFuncHook('sysCall_actuation', resumeThread, true)
    registerScriptFuncHook('sysCall_nonSimulation', resumeThread, true)
end, false)
