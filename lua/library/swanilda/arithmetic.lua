--[[
Arithmetic with texts that are numbers, as in Lua 5.3: the result is a float, where Lua 5.4 keeps integers; bitwise operators accept texts too.
]]

local ARITHMETIC = {
    add = function(a, b) return a + b end,
    sub = function(a, b) return a - b end,
    mul = function(a, b) return a * b end,
    div = function(a, b) return a / b end,
    mod = function(a, b) return a % b end,
    idiv = function(a, b) return a // b end,
    pow = function(a, b) return a ^ b end,
    unm = function(a) return -a end,
}

local BITWISE = {
    band = function(a, b) return a & b end,
    bor = function(a, b) return a | b end,
    bxor = function(a, b) return a ~ b end,
    shl = function(a, b) return a << b end,
    shr = function(a, b) return a >> b end,
    bnot = function(a) return ~a end,
}

local function numberOf(value) return (type(value) == 'string' or type(value) == 'number') and tonumber(value) or nil end

-- The other operand's own, if it is no text.
local function ownOperation(event, a, b)
    local other = type(a) == 'string' and b or a
    local meta = type(other) ~= 'string' and getmetatable(other)
    return type(meta) == 'table' and meta['__' .. event]
end

local function bitwise(event, x, y)
    local i, j = math.tointeger(x), math.tointeger(y)
    if not (i and j) then error('number has no integer representation', 3) end
    return BITWISE[event](i, j)
end

--- The result of an operation of which an operand is a text.
return function(event, a, b)
    local x, y = numberOf(a), numberOf(b)
    if x and y then
        if not BITWISE[event] then return ARITHMETIC[event](x + 0.0, y + 0.0) end
        local result = bitwise(event, x, y)
        return result
    end
    local own = ownOperation(event, a, b)
    if own then return own(a, b) end
    if BITWISE[event] then error(("attempt to perform bitwise operation on a %s value"):format(type(x and b or a)), 2) end
    error(("attempt to %s a '%s' with a '%s'"):format(event, type(a), type(b)), 2)
end
