--[[
Calls of functions by the embedding program.

What is written in Lua runs in a Lua state beside the program's script. Names of the program's functions among the arguments, which begin
with FUNCTION, become functions that call the program. A call from outside of the simulation loop is a coroutine, so that it can wait
for steps; the program runs the steps.
]]

local FUNCTION <const> = 'native function '
local DEPTH <const> = 8 -- levels of tables in which functions are looked for
local M = {}
local waiting, count = {}, 0 -- coroutines by number

setAutoYield(false)

local function function_of(script, name)
    local sim = require 'sim'
    return function(...) return sim.callScriptFunction(name, script, ...) end
end

local function withFunctions(script, value, depth)
    if type(value) == 'string' and value:sub(1, #FUNCTION) == FUNCTION then return function_of(script, value) end
    if type(value) ~= 'table' or depth == 0 or isbuffer(value) then return value end
    for key, item in pairs(value) do value[key] = withFunctions(script, item, depth - 1) end
    return value
end

local function prepared(script, module, member, count, ...)
    local container = module == '_G' and _G or require(module)
    local f = container[member]
    if f == nil then error(('no such function: %s.%s'):format(module, member), 0) end
    local args = table.pack(...)
    for i = 1, count do args[i] = withFunctions(script, args[i], DEPTH) end
    return f, args
end

--- Calls a function that cannot wait.
function M.call(script, module, member, count, ...)
    local f, args = prepared(script, module, member, count, ...)
    return f(table.unpack(args, 1, count))
end

local function progress(number, ok, ...)
    local task = waiting[number]
    if not ok then
        waiting[number] = nil
        error((...), 0)
    end
    if coroutine.status(task) == 'suspended' then return number end
    waiting[number] = nil
    return false, ...
end

--- Begins a call: false and its results, or its number when it waits for a step.
function M.begin(script, module, member, n, ...)
    local f, args = prepared(script, module, member, n, ...)
    count = count + 1
    waiting[count] = coroutine.create(f)
    return progress(count, coroutine.resume(waiting[count], table.unpack(args, 1, n)))
end

--- Goes on with a call; as begin.
function M.resume(number)
    if not waiting[number] then error('there is no such call', 0) end
    return progress(number, coroutine.resume(waiting[number]))
end

--- Ends a call.
function M.cancel(number)
    if waiting[number] then coroutine.close(waiting[number]) end
    waiting[number] = nil
end

--- Loads a module.
function M.require(module) require(module) end

--- Its type and, if it is a plain value, the member of a module.
function M.member(module, name)
    local found = require(module)
    if type(found) ~= 'table' then return end
    local value = found[name]
    if value == nil then return end
    if type(value) == 'function' then return 'function' end
    return type(value), value
end

--- The names of a module's members, in alphabetical order.
function M.members(module)
    local names, found = {}, require(module)
    if type(found) ~= 'table' then return names end
    for name in pairs(found) do
        if type(name) == 'string' then names[#names + 1] = name end
    end
    table.sort(names)
    return names
end

return M
