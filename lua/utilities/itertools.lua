--[[
Chains of iterators, and tables of arrangements.

Iterators are functions that return nil at their end, like those of table.iter or string.gmatch.
]]

local itertools = {}

--- The values of several iterators, one after the other.
-- @api func next = itertools.chain(...)
function itertools.chain(...)
    local iterators, current = {...}, 1
    local function pass(first, ...)
        if first ~= nil then return true, first, ... end
        return false
    end
    local function unwrap(found, ...)
        if found then return ... end
        current = current + 1
        if not iterators[current] then return nil end
        return unwrap(pass(iterators[current]()))
    end
    return function()
        if not iterators[current] then return nil end
        return unwrap(pass(iterators[current]()))
    end
end

--- The same, with a running number in front of each value.
-- @api func next = itertools.ichain(...)
function itertools.ichain(...)
    local iterator, i = itertools.chain(...), 0
    return function()
        local value = iterator()
        if value == nil then return nil end
        i = i + 1
        return i, value
    end
end

--- All rows with one element of each table.
-- @api table rows = itertools.product(table tables)
function itertools.product(tables)
    local rows = {{}}
    for _, t in ipairs(tables) do
        local longer = {}
        for _, row in ipairs(rows) do
            for _, value in ipairs(t) do
                local copy = table.move(row, 1, #row, 1, {})
                copy[#copy + 1] = value
                longer[#longer + 1] = copy
            end
        end
        rows = longer
    end
    return rows
end

-- Selections of `length` elements: each at most once, or not; in the order of t (ordered), or in every order.
local function select_(t, length, once, ordered)
    local result, chosen, used = {}, {}, {}
    local function extend(first)
        if #chosen == length then
            result[#result + 1] = table.move(chosen, 1, length, 1, {})
            return
        end
        for i = first, #t do
            if not (once and used[i]) then
                chosen[#chosen + 1], used[i] = t[i], true
                extend(ordered and (once and i + 1 or i) or 1)
                chosen[#chosen], used[i] = nil, nil
            end
        end
    end
    extend(1)
    return result
end

--- Ordered selections of elements.
-- @api table rows = itertools.permutations(table t, int length = #t)
function itertools.permutations(t, length) return select_(t, length or #t, true, false) end

--- Selections of elements in the order of t.
-- @api table rows = itertools.combinations(table t, int length = #t)
function itertools.combinations(t, length) return select_(t, length or #t, true, true) end

--- Selections in the order of t, in which elements may repeat.
-- @api table rows = itertools.combinations_with_replacement(table t, int length = #t)
function itertools.combinations_with_replacement(t, length) return select_(t, length or #t, false, true) end

return itertools
