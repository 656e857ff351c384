--[[
Modules and classes of matrices that a script uses without asking for them.

The globals that stand for them, until they are used, are made by implicit.rs.
]]

local M = {}

local EXPLICIT_OFF = 'implicit loading of modules has been disabled because one known module (%s) was loaded explicitly.'
local WARNING <const> = 430 -- sim.verbosity_scriptwarnings; the sim table is not loaded yet

---------------------------------------------------------------- modules

local function loadModule(proxy)
    local name, proxies = rawget(proxy, 1), getmetatable(proxy)
    proxies.loading = true
    local ok, module = pcall(_quietRequire, name)
    proxies.loading = false
    if not ok then error(module, 0) end
    if rawget(_G, name) == proxy then
        _G[name] = module
        proxies.implicit = true
        _usedModule(name, true)
        addLog(WARNING, "module '" .. name .. "' was implicitly loaded.")
    end
    return module
end

function M.index(proxy, key)
    if key == 'registerScriptFuncHook' and rawget(proxy, 1) == 'sim' then return registerScriptFuncHook end
    return loadModule(proxy)[key]
end

function M.newIndex(proxy, key, value) loadModule(proxy)[key] = value end

--- The script requires a module after it has used one without.
function M.forbid(name) addLog(WARNING, EXPLICIT_OFF:format(name)) end

---------------------------------------------------------------- classes of matrices

local function class(standIn)
    local name = rawget(standIn, getmetatable(standIn))
    if rawget(_G, name) == standIn then
        addLog(WARNING, "module 'matrix' was implicitly loaded.")
        _quietRequire('matrix.globals')
    end
    return _G[name]
end

function M.indexClass(standIn, key) return class(standIn)[key] end
function M.callClass(standIn, ...) return class(standIn)(...) end

return M
