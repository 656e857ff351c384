--[[
Arithmetic with texts that are numbers, as in Lua 5.3: the result is a float, where Lua 5.4 keeps integers; bitwise operators accept texts too.

Returns the functions of the events, by name: add, band, ...
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

local M = {}

local CALLER <const> = 3 -- the line with the operator; between is the native function that loads this file

local function numberOf(value) return (type(value) == 'string' or type(value) == 'number') and tonumber(value) or nil end

-- The other operand's own, if it is no text.
local function ownOperation(event, a, b)
    local other = type(a) == 'string' and b or a
    local meta = type(other) ~= 'string' and getmetatable(other)
    return type(meta) == 'table' and meta['__' .. event]
end

for event, compute in pairs(ARITHMETIC) do
    M[event] = function(a, b)
        local x, y = numberOf(a), numberOf(b)
        if x and y then return compute(x + 0.0, y + 0.0) end
        local own = ownOperation(event, a, b)
        if own then return own(a, b) end
        error(("attempt to %s a '%s' with a '%s'"):format(event, type(a), type(b)), CALLER)
    end
end

for event, compute in pairs(BITWISE) do
    M[event] = function(a, b)
        local x, y = numberOf(a), numberOf(b)
        local own = not (x and y) and ownOperation(event, a, b)
        if own then return own(a, b) end
        if not (x and y) then error(('attempt to perform bitwise operation on a %s value'):format(type(x and b or a)), CALLER) end
        x, y = math.tointeger(x), math.tointeger(y)
        if not (x and y) then error('number has no integer representation', CALLER) end
        return compute(x, y)
    end
end

return M
