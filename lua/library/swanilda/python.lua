--[[
The Lua side of a script in Python: calls of what is not native, functions of the process as Lua functions, and the coroutine that stands
for the thread of the script.

Does not talk to the process: that is native (_swanilda_python), as are calls of native functions.
]]

local _, rows = ...
local sim = require('sim')
local namespaces = require('remote.namespaces')
local native = _swanilda_python
_G._swanilda_python = nil
_G.sim = sim

local pack, unpack, yield = table.pack, table.unpack, coroutine.yield
local CALLBACK <const> = '^(.*)@func$'
local MAX_SEARCHED <const> = 16 -- entries of a table that are looked through for functions

local M = {}

---------------------------------------------------------------- functions of the process

local functions = setmetatable({}, {__mode = 'v'}) -- by name: the same function stays the same value while somebody has it

local function functionOf(name)
    local f = functions[name]
    if not f then
        f = function(...) return native.ask(name, ...) end
        functions[name] = f
    end
    return f
end

local function withFunctions(value, depth)
    if type(value) == 'string' then
        local name = value:match(CALLBACK)
        return name and functionOf(name) or value
    end
    if depth == 0 and type(value) == 'table' and not getmetatable(value) then
        local looked = 0
        for key, entry in pairs(value) do
            looked = looked + 1
            if looked > MAX_SEARCHED then break end
            value[key] = withFunctions(entry, 1)
        end
    end
    return value
end

---------------------------------------------------------------- what the process asks for besides functions of the simulator

local SPECIAL = {}

function SPECIAL.__require__(name)
    local path = name:match('^[^-]*')
    if path == 'sim' then return path end
    _G[path] = require(name)
    return path
end

--- 'function', 'table', 'constant' with the value, or nothing.
function SPECIAL.__member__(path)
    if SPECIAL[path] then return 'function', nil end
    local ok, value = pcall(namespaces.find, path)
    if not ok or value == nil then return '', nil end
    local kind = type(value)
    if kind == 'function' then return kind, nil end
    if kind == 'table' then return getmetatable(value) and getmetatable(value).__call and 'function' or kind, nil end
    return 'constant', value
end

function SPECIAL.__members__(path)
    local value = namespaces.find(path)
    if value == sim then return rows.members() end
    local names = {}
    for name in pairs(type(value) == 'table' and value or {}) do
        if type(name) == 'string' then names[#names + 1] = name end
    end
    table.sort(names)
    return names
end

function SPECIAL.__script__(target, scriptType)
    if type(target) == 'string' then target = sim.getObject(target) end
    if not sim.isHandle(target) or sim.getObjectType(target) == sim.sceneobject_script then return target end
    return sim.getScript(scriptType or sim.scripttype_customization, target)
end

function SPECIAL.__help__(name) return require('swanilda.console').help(name) end

-- Errors of functions are exceptions, which a script may catch: nothing has to be protected.
SPECIAL['sim.protectedCalls'] = function() end

SPECIAL['sim.testCB'] = function(a, callback, b, times)
    for _ = 1, times or 99 do callback(a, b) end
    return callback(a, b)
end

-- Known to every Python client, with at least one result.
SPECIAL['sim.callScriptFunction'] = function(...)
    local results = pack(sim.callScriptFunction(...))
    if results.n == 0 then return nil end
    return unpack(results, 1, results.n)
end

---------------------------------------------------------------- calls

local LISTS <const> = {__members__ = true}

local function call(name, ...)
    local f = SPECIAL[name] or namespaces.find(name)
    if not f then error('No such function: ' .. name, 0) end
    local args = pack(...)
    for i = 1, args.n do args[i] = withFunctions(args[i], 0) end
    return f(unpack(args, 1, args.n))
end

-- The type of the first result; false where none is declared.
local function declared(name)
    local types = rows.returns(name)
    return types and (types[1] or '') or LISTS[name] and '' or false
end

--- Calls a function by its name. Returns what is declared about its results, then these.
function M.serve(name, ...) return declared(name), call(name, ...) end

---------------------------------------------------------------- the thread

local function serveThread(name, ...)
    native.reply(xpcall(M.serve, tostring, name, ...))
    return true
end

-- Returns false when the thread has ended.
local function act(name, ...)
    if name == nil then return false end
    if name == false then
        yield()
        return true
    end
    return serveThread(name, ...)
end

function M.defineThread()
    function _G.sysCall_thread()
        while act(native.turn()) do end
    end
end

return M
