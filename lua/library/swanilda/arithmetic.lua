--[[
Arithmetic with texts that are numbers: the result is a float, as in Lua 5.3. Lua 5.4 keeps integers.
]]

local OPERATIONS = {
    __add = function(a, b) return a + b end,
    __sub = function(a, b) return a - b end,
    __mul = function(a, b) return a * b end,
    __div = function(a, b) return a / b end,
    __mod = function(a, b) return a % b end,
    __idiv = function(a, b) return a // b end,
    __pow = function(a, b) return a ^ b end,
    __unm = function(a) return -a end,
}

local function float(value)
    local number = (type(value) == 'string' or type(value) == 'number') and tonumber(value)
    return number and number + 0.0
end

-- The other operand's own, if it is no text.
local function ownOperation(event, a, b)
    local other = type(a) == 'string' and b or a
    local meta = type(other) ~= 'string' and getmetatable(other)
    return type(meta) == 'table' and meta[event]
end

--- The result of an operation of which an operand is a text.
return function(event, a, b)
    local x, y = float(a), float(b)
    if x and y then return OPERATIONS[event](x, y) end
    local own = ownOperation(event, a, b)
    if own then return own(a, b) end
    error(("attempt to %s a '%s' with a '%s'"):format(event:sub(3), type(a), type(b)), 2)
end
