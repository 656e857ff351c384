--[[
Bootstrap of a fresh Lua state; runs once, before any user code.

Does: the wrapped standard functions that are no native ones (require, pcall, assert), and the loading of what a script may use but usually does
not.
Returns the function that does it. What stands for those functions until then is native: see stand_ins.rs and implicit.rs.
Does not: hold any of those functions (swanilda/display.lua, functional/functions.lua, ...), nor the sim table.

Every script runs this file: each closure and table here costs memory in each of them.
]]

local beginThread, removeProxies, proxies = ...
local rawrequire, rawpcall = require, pcall
local error, rawget, select, unpack_ = error, rawget, select, table.unpack
local setYieldAllowed, usedModule = setYieldAllowed, _usedModule

-- io.write and print go to the same place: without a buffer of its own, what io.write writes stays in order.
io.stdout:setvbuf('no')

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
    -- The line of the call is in the messages of native functions that are called here: it stays the same from release to release, for who
    -- compares logs.
    return unprotect(rawpcall(...))
end

function assert(value, ...)
    if value then return value, ... end
    local message = ...
    error(message == nil and 'assertion failed!' or message, 2)
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

function require(name)
    if math.type(name) == 'integer' and package.loaded.sim then return quietRequire('swanilda.modload').fromScript(name) end
    local module
    if type(name) == 'string' and package.loaded[name] == nil and coroutine.isyieldable() and getYieldAllowed() then
        module = quietRequire('swanilda.modload').inThread(name)
    end
    module = module or quietRequire(name == 'sim.Object' and 'swanilda.object' or name)
    if proxies and not proxies.loading and removeProxies(name) then
        if proxies.implicit then quietRequire('swanilda.implicit').forbid(name) end
        proxies = nil
    end
    usedModule(name)
    return module
end

-- For other files of the library.
rawset(_ENV, '_quietRequire', quietRequire)
rawset(_ENV, '_randomseed', math.randomseed)

---------------------------------------------------------------- things loaded at first use

loadstring, unpack, quit, exit = load, unpack_, quitSimulator, quitSimulator
sim_plugin_namespaces = {}
registerScriptFuncHook('sysCall_init', beginThread, false)

local files = {}

-- Calls a function of a file. It replaces what stood for it as a global, unless the script has put its own there.
return function(module, name, standIn, ...)
    local functions = files[module]
    if not functions then
        functions = quietRequire(module)
        files[module] = functions
    end
    local f = functions[name]
    if standIn and rawget(_G, name) == standIn then _G[name] = f end
    return f(...)
end
