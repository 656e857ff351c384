--[[
Formatting of values for print and similar functions, as in CoppeliaSim 4.10.

Does not write anywhere itself: a finished line goes to the host function _print.
]]

local M = {}

local LONG <const> = 160 -- longer strings are named instead of shown, longer maps get one line per entry
local RANK = {boolean = 1, number = 2, string = 3, ['function'] = 4, userdata = 5, thread = 6, table = 7}
local format, concat = string.format, table.concat

local function float(v)
    local text = format('%.6f', v):gsub('(%.%d-)0+$', '%1')
    return text:find('.', 1, true) and text or text .. '.'
end

local function quoted(s)
    if #s > LONG then return format('[long string (%d bytes)]', #s) end
    return "'" .. s:gsub("[\\']", '\\%0') .. "'"
end

local function isArray(t)
    local count = 0
    for key in next, t do
        if math.type(key) ~= 'integer' or key < 1 then return false end
        count = count + 1
    end
    return count == 0 or (rawget(t, count) ~= nil)
end

local function keyText(key)
    if type(key) == 'string' then return key:find('^[%a_][%w_]*$') and key or '[' .. quoted(key) .. ']' end
    return '[' .. tostring(key) .. ']'
end

-- Values first by type: what is short and simple is shown before what is long.
local function sortedEntries(t)
    local entries = {}
    if rawequal(t, _G) then pairs(t) end -- names that are there when they are looked up
    for key, value in next, t do
        entries[#entries + 1] = {key = key, name = tostring(key), value = value, rank = RANK[type(value)] or 0}
    end
    table.sort(entries, function(a, b)
        if a.rank ~= b.rank then return a.rank < b.rank end
        return a.name < b.name
    end)
    return entries
end

local nested

local function arrayText(t, path, indent)
    local parts = {}
    for i = 1, #t do parts[i] = nested(t[i], path, indent) end
    return '{' .. concat(parts, ', ') .. '}'
end

local function mapText(t, path, indent)
    local parts = {}
    local blanks = indent and ('    '):rep(indent + 1)
    for i, entry in ipairs(sortedEntries(t)) do
        local value = nested(entry.value, path, indent and indent + 1)
        parts[i] = (blanks or '') .. keyText(entry.key) .. ' = ' .. value .. (indent and ',\n' or ', ')
    end
    if indent then return '{\n' .. concat(parts) .. ('    '):rep(indent) .. '}' end
    return '{' .. concat(parts) .. '}'
end

-- indent: nil while everything still fits on a line, else the level of the lines of this table
local function tableText(t, path, indent)
    if isbuffer(t) then return format('[buffer (%d bytes)]', #t) end
    local meta = getmetatable(t)
    if type(meta) == 'table' and meta.__tostring then return tostring(t) end
    if path[t] then return tostring(t) .. ' (already visited)' end
    path[t] = true
    local text
    if isArray(t) then
        text = arrayText(t, path, indent)
    else
        text = mapText(t, path, indent)
        if not indent and #text > LONG then text = mapText(t, path, 0) end
    end
    path[t] = nil
    return text
end

local function plain(v)
    if math.type(v) == 'float' then return float(v) end
    return tostring(v)
end

function nested(v, path, indent)
    local kind = type(v)
    if kind == 'string' then return quoted(v) end
    if kind == 'table' then return tableText(v, path, indent) end
    return plain(v)
end

local function topLevel(v)
    local kind = type(v)
    if kind == 'string' then return v end
    if kind == 'table' then return tableText(v, {}) end
    return plain(v)
end

local function joined(show, ...)
    local n = select('#', ...)
    if n == 1 then return show((...)) end
    local parts = {...}
    for i = 1, n do parts[i] = show(parts[i]) end
    return concat(parts, ', ', 1, n)
end

--- Text of values as a script would write them: strings in quotes.
function M.getAsString(...)
    return joined(function(v)
        if type(v) == 'string' then return "'" .. v:gsub("[\\']", '\\%0') .. "'" end
        return topLevel(v)
    end, ...)
end

--- Text of values as print shows them.
function M.getAsDisplayString(...) return joined(topLevel, ...) end

function M.print(...)
    if select('#', ...) == 0 then return _print('') end
    _print(joined(topLevel, ...))
end

function M.printf(fmt, ...)
    local values = {...}
    for i = 1, select('#', ...) do
        if isbuffer(values[i]) then values[i] = tostring(values[i]) end
    end
    _print(format(fmt, table.unpack(values, 1, select('#', ...))))
end

--- The print of plain Lua: values through tostring, separated by tabs.
function M.printToConsole(...)
    local parts = {...}
    for i = 1, select('#', ...) do parts[i] = tostring(parts[i]) end
    _print(concat(parts, '\t'))
end

return M
