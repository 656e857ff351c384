--[[
Names of assertions, matchers and modifiers, and the chains made of them: `assert.is_not.same`, `match.is_number`.
]]

local chain = {}

local entries = {}

--- Enters `entry` under a name of one or more words; nil takes it out.
function chain.register(kind, name, entry)
    entries[kind] = entries[kind] or {}
    entries[kind][name:lower()] = entry
end

-- The longest name that ends with word number `last`, and the number of words before it.
local function nameEndingAt(kind, words, last)
    local names = entries[kind] or {}
    for first = 1, last do
        local entry = names[table.concat(words, '_', first, last)]
        if entry then return entry, first - 1 end
    end
end

--- What a chain says: its modifiers in order, and the assertion or matcher at its end, if there is one; others before it mean nothing.
--- Gives nil and the words not understood otherwise.
function chain.parse(kind, words)
    local modifiers = {}
    local entry, rest = nameEndingAt(kind, words, #words)
    rest = rest or #words
    while rest > 0 do
        local modifier, before = nameEndingAt('modifier', words, rest)
        if modifier then table.insert(modifiers, 1, modifier) end
        before = before or select(2, nameEndingAt(kind, words, rest))
        if not before then return nil, table.concat(words, '_', 1, rest) end
        rest = before
    end
    return modifiers, entry
end

-- A copy of a state; what modifiers left in it goes with it.
local function copy(state, words)
    local new = {}
    for key, value in next, state do new[key] = value end
    new.tokens = words
    return setmetatable(new, getmetatable(state))
end

--- The state with the words of `key` added.
function chain.extend(state, key)
    local words = table.move(state.tokens, 1, #state.tokens, 1, {})
    for word in tostring(key):gmatch('[^_]+') do words[#words + 1] = word:lower() end
    return copy(state, words)
end

--- The state after its modifiers. The last of them gets the arguments when no assertion follows.
function chain.modify(state, modifiers, arguments, level)
    state = copy(state, {})
    for i, modifier in ipairs(modifiers) do
        local own = i == #modifiers and arguments or nil
        local changed = modifier.callback(state, own, level + 1)
        state = changed or state
    end
    return state
end

--- The metatable of the states of one kind of chain.
function chain.metatable(call) return {__index = chain.extend, __call = call} end

--- A state at the beginning of a chain.
function chain.start(metatable) return setmetatable({mod = true, tokens = {}}, metatable) end

return chain
