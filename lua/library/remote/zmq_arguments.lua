--[[
Decodes the arguments of a request of the ZeroMQ remote API, including control words.
]]

local NIL <const> = '_*NIL*_'
local CALLBACK <const> = '@func' -- at the end of the name of a function of the client
local MAX_SEARCHED <const> = 16 -- entries of a table that are looked through for callbacks
local MAX_ARGUMENTS <const> = 100000

local M = {}

--- The arguments and their number: a trailing null is only visible in the number.
function M.given(request)
    local args = type(request.args) == 'table' and request.args or {}
    local n = math.tointeger(request.argsL) or #args
    if n > MAX_ARGUMENTS then error('too many arguments', 0) end
    return args, math.max(0, n)
end

local function withCallbacks(client, value, callbackOf, depth)
    if type(value) == 'string' then
        -- Not with a pattern: that would go through all of a long text.
        local isCallback = value:sub(-#CALLBACK) == CALLBACK
        return isCallback and callbackOf(client, value:sub(1, -#CALLBACK - 1)) or value
    end
    if depth == 0 and type(value) == 'table' and not getmetatable(value) then
        local looked = 0
        for key, entry in pairs(value) do
            looked = looked + 1
            if looked > MAX_SEARCHED then break end
            value[key] = withCallbacks(client, entry, callbackOf, 1)
        end
    end
    return value
end

--- The arguments as the function gets them, and their number. `callbackOf` makes a function of a name of the client.
function M.arguments(client, request, callbackOf)
    local args, n = M.given(request)
    for i = 1, n do
        local value = args[i]
        local kind = type(value)
        if kind == 'string' or kind == 'table' then
            if value == NIL then value = nil end
            args[i] = withCallbacks(client, value, callbackOf, 0)
        end
    end
    return args, n
end

return M
