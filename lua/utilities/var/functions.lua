--[[
The functions of the module var, which are global in every script: variables by name, local variables of a running function, and texts with
values in braces.
]]

local M = {}

-- The key that is written in brackets: 2, 'x', "x", or a word without quotes.
local function inBrackets(text)
    local quoted = text:match('^%s*"(.*)"%s*$') or text:match("^%s*'(.*)'%s*$")
    return quoted or tonumber(text) or text
end

-- The keys in a.b[2]['c'].
local function keysOf(name)
    local keys, at = {}, 1
    while at <= #name do
        local _, last, word = name:find('^([^.%[%]]+)', at)
        local _, lastInBrackets, inside = name:find('^%[([^%]]*)%]', at)
        if word then
            keys[#keys + 1] = tonumber(word) or word
        elseif inside then
            keys[#keys + 1] = inBrackets(inside)
        end
        at = (last or lastInBrackets or at) + 1
    end
    return keys
end

--- Value of a name such as a.b[2]['c'], starting in context (default: the globals); nil where a part is missing.
-- @api any value = var.getvar(string name, table context = _G)
function M.getvar(name, context)
    local value = context or _G
    for _, key in ipairs(keysOf(name)) do
        if type(value) ~= 'table' then return nil end
        value = value[key]
    end
    return value
end

--- Sets the variable of a name such as a.b[2]['c']; missing tables on the way are created.
-- @api var.setvar(string name, any value, table context = _G)
function M.setvar(name, value, context)
    local owner, keys = context or _G, keysOf(name)
    for i = 1, #keys - 1 do
        if owner[keys[i]] == nil then owner[keys[i]] = {} end
        owner = owner[keys[i]]
    end
    owner[keys[#keys]] = value
end

-- The first call of a global function goes through the native one that stood for it.
local function isStandIn(level, name)
    local info = debug.getinfo(level + 1, 'Sn')
    return info and info.what == 'C' and info.name == name
end

local function localsOf(level)
    local result, i = {}, 1
    while true do
        local name, value = debug.getlocal(level + 1, i)
        if not name then return result end
        if name:sub(1, 1) ~= '(' then result[name] = value end
        i = i + 1
    end
end

--- Local variables of the function at a level of the stack (1: the caller), by name.
-- @api table values = var.getlocals(int level = 1)
function M.getlocals(level)
    local values = localsOf((level or 1) + (isStandIn(2, 'getlocals') and 2 or 1))
    return values
end

local function formatted(name, isNamed, format, value)
    if format ~= '' and format:sub(1, 1) ~= '%' then format = '%' .. format end
    local text = format ~= '' and format:format(value) or getAsDisplayString(value)
    return (isNamed and name .. '=' or '') .. text
end

--- 'x is {x}' with the local or global variables of the caller; {x=} writes the name too, {x:.3f} formats. Unknown names stay as they are.
-- @api string result = var.f(string text)
function M.f(text)
    local locals = localsOf(isStandIn(2, 'f') and 3 or 2)
    return (text:gsub('{([^{}]+)}', function(field)
        local name, equals, format = (field .. ':'):match('^(.-)(=?):(.*)$')
        local value = M.getvar(name, locals)
        if value == nil then value = M.getvar(name) end
        return value ~= nil and formatted(name, equals == '=', format:sub(1, -2), value) or nil
    end))
end

function M.unittest()
    local context = {a = {b = {1, 2}}}
    M.setvar('a.c.d', 3, context)
    M.setvar("a['e'][2]", 4, context)
    assert(M.getvar('a.b[2]', context) == 2 and M.getvar('a.c.d', context) == 3 and M.getvar('x.y', context) == nil)
    assert(M.getvar('a.b.2', context) == 2 and M.getvar('["a"].e[2]', context) == 4)
    local x, n = 1.5, nil
    assert(M.f('{x:.2f} {x:%.1f} {x=} {x} {n}') == '1.50 1.5 x=1.5 ' .. getAsDisplayString(x) .. ' {n}' and n == nil)
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return M
