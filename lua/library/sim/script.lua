--[[
Calls to other scripts by name, lookup of objects by path, and information about the calling script.

Does not resolve paths or pass values between states: that is native (sim._getObject, sim.callScriptFunction).
]]

local sim = ...
local M = {}

--- Handle of the object at a path.
-- @api int objectHandle = sim.getObject(string path, map options = {})
-- @param path /a/b from the top, ./a below this script's object, .. for the parent, : for the model
-- @param options index: take another match; proxy: object to start from; noError: -1 instead of an error
-- @return objectHandle the first match
function M.getObject(path, options)
    -- Not a tail call: error texts of 4.10 carry the line of this wrapper, not of the caller.
    local handle = sim._getObject(path, options)
    return handle
end

local FIRST_SCRIPT <const> = 1010000 -- handles from here on are scripts that are no scene objects

local function isScriptObject(handle) return sim.isHandle(handle) and sim.getObjectType(handle) == sim.sceneobject_script end

local function scriptOf(target, scriptType)
    if type(target) == 'string' then target = M.getObject(target) end
    if not sim.isHandle(target) or target >= FIRST_SCRIPT or isScriptObject(target) then return target end
    return sim.getScript(scriptType or sim.scripttype_customization, target)
end

local function method(handle, name)
    return function(proxy, ...)
        local meta = type(proxy) == 'table' and getmetatable(proxy)
        if type(meta) ~= 'table' or not meta.isScriptFunctions then
            error('methods must be called with object:method(args...)', 2)
        end
        return sim.callScriptFunction(name, handle, ...)
    end
end

--- An object whose methods are the global functions of another script: proxy:name(...).
-- @api map proxy = sim.getScriptFunctions(int handle, int scriptType = sim.scripttype_customization)
-- @param handle script, object that has a script, or path to one
-- @param scriptType which script of an object that is none itself
-- @return proxy calls through sim.callScriptFunction
function M.getScriptFunctions(handle, scriptType)
    local script = scriptOf(handle, scriptType)
    return setmetatable({}, {
        isScriptFunctions = true,
        __index = function(_, name) return method(script, name) end,
        __tostring = function() return 'functions of script ' .. tostring(script) end,
    })
end

-- Globals a script has not set itself but that are not in a fresh state either.
local ENGINE_GLOBALS = {
    sim_script_handle = true, sim_plugin_namespaces = true, sim_script_name_index = true, __coroutine__ = true,
    operator = true, arg = true,
}

local function isUserVariable(name, value)
    if type(name) ~= 'string' or ENGINE_GLOBALS[name] then return false end
    if type(value) == 'function' or package.loaded[name] == value then return false end
    return not (type(value) == 'table' and name:find('^sim%u?%w*$') or name:find('^_'))
end

--- Names of the global variables of this script that are not functions.
-- @api string[] variables = sim.getUserVariables()
-- @return variables sorted
function M.getUserVariables()
    local names = {}
    for name, value in next, _G do
        if isUserVariable(name, value) then names[#names + 1] = name end
    end
    table.sort(names)
    return names
end

--- Runs Lua code in this script.
-- @api bool success, any value = sim.executeLuaCode(string code)
-- @param code text of a chunk
-- @return success false if the code does not compile or raises
-- @return value first result, or the error
function M.executeLuaCode(code)
    local chunk, message = load(code)
    if not chunk then return false, message end
    return pcall(chunk)
end

--- Names of the plugins this script has loaded, with the modules that are plugins in CoppeliaSim.
-- @api string[] names = sim.getLoadedPlugins()
-- @return names sorted
function M.getLoadedPlugins()
    local names, native = {}, sim_plugin_namespaces or {}
    for name in pairs(native) do names[#names + 1] = name end
    for name in pairs(package.loaded) do
        if type(name) == 'string' and name:find '^sim%u%w*$' and not native[name] then names[#names + 1] = name end
    end
    table.sort(names)
    return names
end

--- Whether a plugin was loaded by this script.
-- @api bool loaded = sim.isPluginLoaded(string name)
-- @param name for instance simIK
-- @return loaded true if so
function M.isPluginLoaded(name)
    if sim_plugin_namespaces and sim_plugin_namespaces[name] then return true end
    return type(package.loaded[name]) == 'table' or package.preload[name] ~= nil
end

--- Loads a plugin of this simulator.
-- @api int handle = sim.loadPlugin(string name)
-- @param name for instance simIK
-- @return handle 0, or -1 if it cannot be loaded, which is logged
function M.loadPlugin(name)
    return loadPlugin(name) and 0 or -1
end

--- Lets the idle loop run without pauses; it always does here, so this does nothing.
-- @api sim.fastIdleLoop(bool enable)
-- @param enable ignored
function M.fastIdleLoop(_) end

local function includeFile(path)
    local chunk, message = loadfile(path)
    if not chunk then error(message, 3) end
    return chunk()
end

--- Runs a file, given by its absolute path.
-- @api any result = sim.includeAbs(string path)
-- @param path of a Lua file
-- @return result of the file
function M.includeAbs(path)
    local result = includeFile(path)
    return result
end

local function scenePath(path)
    local folder = sim.getStringProperty(sim.handle_scene, 'scenePath', {noError = true}) or ''
    folder = folder:match('^(.*)[/\\]') or '.'
    return folder .. '/' .. path
end

--- Runs a file, given by its path relative to the folder of the scene.
-- @api any result = sim.includeRel(string path)
-- @param path of a Lua file
-- @return result of the file
function M.includeRel(path)
    local result = includeFile(scenePath(path))
    return result
end

local function exists(path)
    local file = io.open(path)
    return file ~= nil and file:close()
end

--- Runs a file, given by its path relative to the folder of the scene. Where there is none, '/lua/name.lua' is the module of that name.
-- @api any result = sim.include(string path, string command = nil)
-- @param path of a Lua file
-- @param command Lua text to run before it
-- @return result of the file
function M.include(path, command)
    if command then assert(load(command))() end
    local file = scenePath(path)
    local module = path:match('^[/\\]?lua[/\\](.+)%.lua$')
    if module and not exists(file) then return (require((module:gsub('[/\\]', '.')))) end
    local result = includeFile(file)
    return result
end

--- Sets a global variable of another script.
-- @api int result = sim.setScriptVariable(string variableNameAtScriptName, int scriptHandleOrType, any variable)
-- @param variableNameAtScriptName the variable; after an @ the object whose script is meant
-- @param scriptHandleOrType the script, or sim.scripttype_* with an object; without one sim.scripttype_main
-- @param variable its new value
-- @return result 1
function M.setScriptVariable(variableNameAtScriptName, scriptHandleOrType, variable)
    local name, object = variableNameAtScriptName:match('^([^@]*)@?(.*)$')
    local script = scriptHandleOrType
    if object ~= '' then
        script = sim.getScript(scriptHandleOrType, sim._simGetObjectHandle(object))
    elseif script == sim.scripttype_main and not isScriptObject(script) then
        script = sim.getScript(script)
    end
    sim.callScriptFunction('setvar', script, name, variable)
    return 1
end

return M
