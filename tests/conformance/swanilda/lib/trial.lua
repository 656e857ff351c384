--[[
What cases that try many calls share: `try(what, f, ...)` prints what f returns, or its error without the place.
]]

local M = {}

--- Floats with eight digits, tables in braces.
function M.text(value)
    if math.type(value) == 'float' then
        return (string.format('%.8f', value):gsub('^-(0%.0+)$', '%1'))
    elseif type(value) ~= 'table' then
        return tostring(value)
    end
    local t = {}
    for i, x in ipairs(value) do t[i] = M.text(x) end
    return '{' .. table.concat(t, ' ') .. '}'
end

function M.try(what, f, ...)
    local r = table.pack(pcall(f, ...))
    if not r[1] then
        local message = tostring(r[2]):gsub('\nstack traceback.*', ''):gsub('^.-in sim', 'sim'):gsub('^%[.-%]:%d+: ', '')
        return print(what, 'error', message)
    end
    local t = {}
    for i = 2, r.n do t[i - 1] = M.text(r[i]) end
    print(what, table.concat(t, ' '))
end

return M
