--[[
Chains of tables, and tables of arrangements.
]]

local itertools = {}

-- The keys and values of each table in turn, those that iterate(table) gives. A function among them is an iterator itself: it gives its own
-- values until the first of them is nil.
local function chained(iterate, ...)
    local sources, current = {...}, 0
    local function nothing() end
    local step, state, key = nothing, nil, nil
    local function following(first, ...)
        if first ~= nil then
            key = first
            return first, ...
        end
        current = current + 1
        local source = sources[current]
        step, state, key = source or nothing, nil, nil
        if source == nil then return nil end
        if type(source) ~= 'function' then step, state, key = iterate(source) end
        return following(step(state, key))
    end
    return function() return following(step(state, key)) end
end

--- The keys and values of several tables, one after the other.
-- @api func next = itertools.chain(...)
function itertools.chain(...) return chained(pairs, ...) end

--- The indices and elements of several tables, one after the other: up to the first that is nil in each.
-- @api func next = itertools.ichain(...)
function itertools.ichain(...) return chained(ipairs, ...) end

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
