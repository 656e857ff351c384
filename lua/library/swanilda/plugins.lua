--[[
loadPlugin and unloadPlugin: the functions of a native plugin as a Lua table.

The plugin runs in the simulator; here are only its names. A table is made once for each script.
]]

local M = {}
local loadNative, callNative, unloadNative, programFunctions = _loadPlugin, _callPlugin, _unloadPlugin, _programFunctions

-- Dots in names make tables in tables.
local function put(into, name, value)
    local path, last = name:match('^(.*)%.([^.]*)$')
    for part in (path or ''):gmatch('[^.]+') do
        if type(into[part]) ~= 'table' then into[part] = {} end
        into = into[part]
    end
    into[last or name] = value
end

local function evaluated(expression, plugin)
    local chunk, message = load('return ' .. expression, '=' .. plugin, 't', _G)
    if not chunk then error(message, 0) end
    return (chunk())
end

local function namespace(name) return name:match('^[^-]*') end

--- The functions and variables of a plugin; nothing if it cannot be loaded, which the log says.
function M.loadPlugin(name)
    local known = type(name) == 'string' and sim_plugin_namespaces[namespace(name)]
    if known then return known end
    local plugin = loadNative(name)
    if not plugin then return end
    -- What is a plugin of CoppeliaSim and a module here.
    if type(plugin) == 'string' then return require(namespace(plugin)) end
    local members = {}
    for place, functionName in ipairs(plugin.functions) do
        put(members, functionName, function(...) return callNative(plugin.name, place - 1, ...) end)
    end
    for _, variable in ipairs(plugin.variables) do
        local value = variable.value
        if variable.isExpression then value = evaluated(value, plugin.name) end
        put(members, variable.name, value)
    end
    sim_plugin_namespaces[plugin.name] = members
    return members
end

--- The global `name` among the functions of the program that has loaded the simulator, or the table of those before whose dot it is.
function M.ofProgram(name)
    local members = {}
    for place, functionName in ipairs(programFunctions()) do
        put(members, functionName, function(...) return callNative(nil, place - 1, ...) end)
    end
    return members[name]
end

--- Ends the use of a plugin, which loadPlugin has returned; with options.force, that of all scripts.
function M.unloadPlugin(plugin, options)
    for name, members in pairs(sim_plugin_namespaces) do
        if members == plugin or name == plugin then
            sim_plugin_namespaces[name] = nil
            return unloadNative(name, options and options.force or false)
        end
    end
    error('unloadPlugin: this is no plugin that the script has loaded.', 2)
end

return M
