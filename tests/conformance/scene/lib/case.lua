--[[
What the cases of this folder print with: values, quaternions and errors, in a form that can be compared.
]]

local M = {}

local function number(v)
    if math.type(v) == 'integer' then return string.format('%d', v) end
    if v ~= v then return 'nan' end
    return string.format('%.9f', math.abs(v) < 5e-10 and 0.0 or v)
end

-- Lists in their order, other tables by their keys.
local function elements(v)
    local t, keys = {}, {}
    if #v > 0 or next(v) == nil then
        for i, x in ipairs(v) do t[i] = M.text(x) end
        return t
    end
    for x in pairs(v) do keys[#keys + 1] = tostring(x) end
    table.sort(keys)
    for i, x in ipairs(keys) do t[i] = x .. '=' .. M.text(v[x]) end
    return t
end

--- The text of a value: floats with nine digits, tables in braces.
function M.text(v)
    if type(v) == 'number' then return number(v) end
    if type(v) ~= 'table' then return tostring(v) end
    return '{' .. table.concat(elements(v), ', ') .. '}'
end

--- Prints values.
function M.P(label, ...)
    local t = {}
    for i = 1, select('#', ...) do t[i] = M.text((select(i, ...))) end
    print(label .. ': ' .. table.concat(t, ' '))
end

--- Prints a quaternion or a pose, the sign of the quaternion normalised.
function M.Q(label, t)
    local o, s, r = #t - 4, 0, {}
    for _, i in ipairs({ 4, 1, 2, 3 }) do
        if s == 0 and math.abs(t[o + i]) > 1e-9 then s = t[o + i] end
    end
    for i = 1, #t do r[i] = (i > o and s < 0) and -t[i] or t[i] end
    M.P(label, r)
end

--- Prints the end of the error that f(...) raises, without the place.
function M.X(label, f, ...)
    local ok, e = pcall(f, ...)
    e = tostring(e):gsub('\nstack traceback.*', '')
    e = e:match('in sim[%w_%-]*%.[%w_]+: (.*)$') or e:match("in '[^']*': (.*)$") or e:match(':%d+: (.*)$') or e
    print(label .. ': ' .. (ok and 'no error' or 'error, ' .. e))
end

return M
