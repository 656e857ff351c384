--[[
The keys of a table in the order in which messages show them: the sequence, then numbers, booleans, texts and the rest.
]]

local RANK = {number = 1, boolean = 2, string = 3, table = 4, ['function'] = 5, userdata = 6, thread = 7}

-- Whether `a` goes before `b`; keys that have no order keep that of `found`.
local function precedes(a, b, found)
    local kind = type(a)
    if kind ~= type(b) then return RANK[kind] < RANK[type(b)] end
    if kind == 'number' or kind == 'string' then return a < b end
    if kind == 'boolean' then return a and not b end
    return found[a] < found[b]
end

-- The keys of `t` in order.
local function sortedKeys(t)
    local length = rawlen(t)
    local keys, others, found = {}, {}, {}
    for i = 1, length do
        if rawget(t, i) ~= nil then keys[#keys + 1] = i end
    end
    for key in next, t do
        local inSequence = math.type(key) == 'integer' and key >= 1 and key <= length
        if not inSequence then
            others[#others + 1] = key
            found[key] = #others
        end
    end
    table.sort(others, function(a, b) return precedes(a, b, found) end)
    return table.move(others, 1, #others, #keys + 1, keys)
end

return sortedKeys
