--[[
Lists callable functions for remote API clients: `zmqRemoteApi.require` and `zmqRemoteApi.info`.

Returns a function that defines both in its Lua state; its argument is the list of members of `sim`, which is filled lazily.
]]

local sim = require('sim')

local MAX_DEPTH <const> = 8 -- tables within each other: some lead everywhere

-- The table sim is filled name by name when they are used.
local function membersOf(value, simMembers)
    if value ~= sim then return value end
    local members = {}
    for _, name in ipairs(simMembers()) do members[name] = sim[name] end
    for name, member in next, sim do members[name] = member end
    return members
end

--- What a table has: {func} and {const}, and the same of the tables in it; of objects only with `objects`.
local function describe(value, simMembers, objects, above)
    if type(value) ~= 'table' then return value end
    above = above or {n = 0}
    above[value], above.n = true, above.n + 1
    local out = {}
    for name, member in pairs(membersOf(value, simMembers)) do
        local kind = type(member)
        if kind == 'function' then
            out[name] = {func = {}}
        elseif kind ~= 'table' then
            out[name] = {const = member}
        elseif kind == 'table' and (objects or not getmetatable(member)) and not above[member] and above.n < MAX_DEPTH then
            out[name] = describe(member, simMembers, objects, above)
        end
    end
    above[value], above.n = nil, above.n - 1
    return out
end

local MAX_PATHS <const>, MAX_PATH_LENGTH <const> = 10000, 200 -- remembered
local paths, pathCount = {}, 0

-- The words of a path, which many requests have in common.
local function wordsOf(path)
    local words = {}
    for word in path:gmatch('[%w_]+') do words[#words + 1] = word end
    if #path > MAX_PATH_LENGTH then return words end
    if pathCount >= MAX_PATHS then paths, pathCount = {}, 0 end
    paths[path], pathCount = words, pathCount + 1
    return words
end

--- The global a path like `sim.getObject` leads to; nothing when there is none.
local function find(path)
    local value = _G
    local words = paths[path] or wordsOf(path)
    for i = 1, #words do
        value = value[words[i]]
        if not value then return end
    end
    return value
end

local function install(simMembers)
    zmqRemoteApi = {}

    function zmqRemoteApi.require(name) _G[name:match('^[^-]*')] = require(name) end

    function zmqRemoteApi.info(name)
        local ok, value = pcall(find, name)
        return ok and describe(value, simMembers) or nil
    end
end

return {install = install, find = find, describe = describe}
