--[[
Values as the messages of failed assertions show them.
]]

local sortedKeys = require 'luassert.keys'
local state = require 'luassert.state'

local formatters = {}

local COLORS = {
    black = 30, red = 31, green = 32, yellow = 33, blue = 34, magenta = 35, cyan = 36, white = 37,
}

local function address(value) return ('%s: %p'):format(type(value), value) end

-- With all digits that tell it from its neighbours; a float is never written as an integer.
local function number(value)
    if math.type(value) == 'integer' then return tostring(value) end
    if value ~= value then return 'NaN' end
    if value == math.huge then return 'Inf' end
    if value == -math.huge then return '-Inf' end
    local text = ('%.20g'):format(value)
    if text:find('.', 1, true) then return text end
    return (text:gsub('^-?%d+', '%0.0'))
end

-- The mark before a key that leads to the difference, at the end of its indentation.
local function indentation(depth, isMarked)
    local width = 2 * depth
    if not isMarked then return (' '):rep(width) end
    local mark = state.get_parameter('TableErrorHighlightCharacter')
    local spaces = (' '):rep(width - #mark)
    local color = state.get_parameter('TableErrorHighlightColor')
    if color == 'none' then return spaces .. mark end
    if not COLORS[color] then error(("luassert: unknown color '%s'"):format(color), 0) end
    return ('%s\27[%dm%s\27[0m'):format(spaces, COLORS[color], mark)
end

local element

-- The part of a table between braces. `dump.path` are the keys to mark, the innermost first.
local function braces(t, depth, onPath, dump)
    if next(t) == nil then return '{ }' end
    if dump.open[t] and dump.hidesRecursion then return '{ ... recursive }' end
    if depth > dump.levels then return '{ ... more }' end
    dump.open[t] = true
    local lines = {}
    for _, key in ipairs(sortedKeys(t)) do
        local isMarked = onPath and rawequal(dump.path[#dump.path - depth + 1], key)
        lines[#lines + 1] = ('%s[%s] = %s'):format(indentation(depth, isMarked), tostring(key),
            element(rawget(t, key), depth + 1, isMarked, dump))
    end
    dump.open[t] = nil
    return '{\n' .. table.concat(lines, '\n') .. ' }'
end

function element(value, depth, onPath, dump)
    local kind = type(value)
    if kind == 'table' then return braces(value, depth, onPath, dump) end
    if kind == 'string' then return ("'%s'"):format(value) end
    if kind == 'number' then return number(value) end
    return tostring(value)
end

local function tableText(t, path)
    local levels = state.get_parameter('TableFormatLevel')
    local isUnlimited = levels < 0
    local dump = {
        path = path or {},
        open = {},
        levels = isUnlimited and math.huge or levels,
        hidesRecursion = isUnlimited or state.get_parameter('TableFormatShowRecursion'),
    }
    return ('(%s) %s'):format(address(t), braces(t, 1, path ~= nil, dump))
end

local function functionText(value)
    local info = debug.getinfo(value, 'S')
    return ('%s @ line %d in %s'):format(tostring(value), info.linedefined, info.source)
end

local function plainText(value)
    local kind = type(value)
    local isOpaque = kind == 'userdata' or kind == 'thread'
    return (isOpaque and "(%s) '%s'" or '(%s) %s'):format(kind, element(value))
end

-- The values of a call, made by `formatters.values`.
local ValuesList = {}

function formatters.values(list) return setmetatable({list = list}, ValuesList) end

local function commaSeparated(list) return table.concat(formatters.format(list), ', ') end

local function matcherText(matcher)
    if not matcher.name then return '(matcher) _' end
    return ('(matcher) %s.%s(%s)'):format(matcher.mod and 'is' or 'no', matcher.name, commaSeparated(matcher.arguments))
end

-- The metatable of matchers.
formatters.Matcher = {}

local function text(value, options)
    local own = state.format(value, options)
    if own ~= nil then return own end
    local kind = type(value)
    if kind == 'nil' then return '(nil)' end
    if kind == 'function' then return functionText(value) end
    if kind ~= 'table' then return plainText(value) end
    local metatable = debug.getmetatable(value)
    if metatable == ValuesList then return ('(values list) (%s)'):format(commaSeparated(value.list)) end
    if metatable == formatters.Matcher then return matcherText(value) end
    return tableText(value, options and options.crumbs)
end

--- The values of a list as text. `nofmt[i]` says that value `i` is a text already, `fmtargs[i].crumbs` are the keys to mark in it.
function formatters.format(list)
    local texts = {n = list.n or #list}
    local ready, options = list.nofmt or {}, list.fmtargs or {}
    for i = 1, texts.n do
        texts[i] = ready[i] and tostring(list[i]) or tostring(text(list[i], options[i]))
    end
    return texts
end

return formatters
