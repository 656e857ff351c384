--[[
The functions of the module checkargs, which makes some of them global. The library calls them here: the table is callable as checkargs is.
]]

local checkargs = {}
local check = {}
checkargs.checkarg = check

local function isCallable(v)
    local meta = type(v) == 'table' and getmetatable(v)
    return type(v) == 'function' or (type(meta) == 'table' and meta.__call ~= nil)
end

function check.any() return true end
function check.float(v) return type(v) == 'number', 'must be a float' end
function check.int(v) return math.type(v) == 'integer' or (type(v) == 'number' and v == math.floor(v)), 'must be an int' end
function check.string(v) return type(v) == 'string' or isbuffer(v), 'must be a string' end
function check.bool(v) return type(v) == 'boolean', 'must be a bool' end
function check.func(v) return isCallable(v) or (type(v) == 'string' and type(_G[v]) == 'function'), 'must be a func' end
function check.handle(v) return math.type(v) == 'integer', 'must be a handle' end

function check.object(v, t)
    local meta = type(v) == 'table' and getmetatable(v)
    local right = type(meta) == 'table' and (t.class == nil or meta == t.class or v.class == t.class)
    return right, 'must be an object'
end

local function sizeMessage(n, size)
    local least, most = size, size
    if type(size) == 'string' then
        least, most = size:match('^%s*(%d*)%s*%.%.%s*([%d*]*)')
        if not least then least, most = size, size end
        least, most = tonumber(least) or 0, tonumber(most) or math.huge
    end
    if n >= least and n <= most then return nil end
    if least == most then return ('must have exactly %d elements'):format(least) end
    if n < least then return ('must have at least %d elements'):format(least) end
    return ('must have at most %d elements'):format(most)
end

function check.table(v, t)
    if type(v) ~= 'table' then return false, 'must be a table' end
    local message = t.size and sizeMessage(#v, t.size)
    if message then return false, message end
    if not t.item_type then return true end
    local checkItem = check[t.item_type]
    for i = 1, #v do
        if not checkItem(v[i], t) then return false, 'must be a table of elements of type ' .. t.item_type end
    end
    return true
end

function check.union(v, t)
    local names = {}
    for i, alternative in ipairs(t.union) do
        if check[alternative.type](v, alternative) then return true end
        names[i] = alternative.type
    end
    return false, 'must be any of: ' .. table.concat(names, ', ')
end

local function hasDefault(t) return t.default ~= nil or t.default_nil or t.nullable end

--- The default of a type.
-- @api any value = checkargs.getdefault(table t)
function checkargs.getdefault(t) return t.default end

-- The function that called checkargs is at this level when seen from a function called by checkargsEx.
local function fail(level, text)
    local info = debug.getinfo(level, 'n')
    error((info and info.name or '?') .. ': ' .. text, level + 1)
end

local function required(types)
    for i = #types, 1, -1 do
        if not hasDefault(types[i]) then return i end
    end
    return 0
end

--- Like checkargs; opts.level says how many functions lie between the caller and the function being checked.
-- @api any... values = checkargs.checkargsEx(table opts, table types, ...)
function checkargs.checkargsEx(opts, types, ...)
    local level = 3 + (opts.level or 0)
    local n, values = select('#', ...), {...}
    if n < required(types) then fail(level, 'not enough arguments') end
    if n > #types then fail(level, 'too many arguments') end
    for i, t in ipairs(types) do
        if values[i] == nil and hasDefault(t) then
            values[i] = t.default
        else
            local ok, message = check[t.type](values[i], t)
            if not ok then fail(level, ('argument %d %s'):format(i, message)) end
        end
    end
    return table.unpack(values, 1, #types)
end

--- Checks arguments against a list of types; returns them with defaults filled in.
-- @api any... values = checkargs.checkargs(table types, ...)
-- No tail call, also below: the checked function is found by counting frames.
function checkargs.checkargs(types, ...)
    local results = table.pack(checkargs.checkargsEx({level = 1}, types, ...))
    return table.unpack(results, 1, results.n)
end

setmetatable(checkargs, {__call = function(_, types, ...)
    local results = table.pack(checkargs.checkargsEx({level = 1}, types, ...))
    return table.unpack(results, 1, results.n)
end})

function checkargs.unittest()
    local function f(...)
        local i, s, t = checkargs({{type = 'int'}, {type = 'string', default = 'x'}, {type = 'table', size = 3, default_nil = true}}, ...)
        return i, s, t
    end
    assert(select(2, f(1)) == 'x' and not pcall(f) and not pcall(f, 'a') and not pcall(f, 1, 's', {1}) and pcall(f, 1, nil, {1, 2, 3}))
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return checkargs
