--[[
Variables by dotted name, local variables of a running function, and texts with values in braces.
]]

local M = {}

local function parts(name)
    local names = {}
    for part in name:gmatch('[^.]+') do names[#names + 1] = tonumber(part) or part end
    return names
end

--- Value of a.b.c, starting in context (default: the globals); nil where a part is missing.
-- @api any value = var.getvar(string name, table context = _G)
function M.getvar(name, context)
    local value = context or _G
    for _, part in ipairs(parts(name)) do
        if type(value) ~= 'table' then return nil end
        value = value[part]
    end
    return value
end

--- Sets a.b.c; missing tables on the way are created.
-- @api var.setvar(string name, any value, table context = _G)
function M.setvar(name, value, context)
    local owner, names = context or _G, parts(name)
    for i = 1, #names - 1 do
        if owner[names[i]] == nil then owner[names[i]] = {} end
        owner = owner[names[i]]
    end
    owner[names[#names]] = value
end

--- Local variables of the function at a level of the stack (1: the caller), by name.
-- @api table values = var.getlocals(int level = 1)
function M.getlocals(level)
    local result, i = {}, 1
    while true do
        local name, value = debug.getlocal((level or 1) + 1, i)
        if not name then return result end
        if name:sub(1, 1) ~= '(' then result[name] = value end
        i = i + 1
    end
end

--- 'x is {x}' with the local or global variables of the caller; {x:%.3f} formats.
-- @api string result = var.f(string text)
function M.f(text)
    local locals = M.getlocals(2)
    return (text:gsub('{([^{}]+)}', function(field)
        local name, format = field:match('^(.-):(%%.*)$')
        name = name or field
        local value = M.getvar(name, locals)
        if value == nil then value = M.getvar(name) end
        return format and format:format(value) or getAsDisplayString(value)
    end))
end

function M.unittest()
    local context = {a = {b = {1, 2}}}
    M.setvar('a.c.d', 3, context)
    assert(M.getvar('a.b.2', context) == 2 and M.getvar('a.c.d', context) == 3 and M.getvar('x.y', context) == nil)
    local x = 1.5
    assert(M.f('{x:%.2f} {x}') == '1.50 ' .. getAsDisplayString(x))
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return M
