--[[
The functions of the module mathx. They come into the global math the first time one of them is asked for.
]]

local M = {}
local exp, abs, floor = math.exp, math.abs, math.floor

--- The angle of the vector (x, y).
-- @api float angle = mathx.atan2(float y, float x)
function M.atan2(y, x) return math.atan(y, x) end

--- x to the power of y.
-- @api float result = mathx.pow(float x, float y)
function M.pow(x, y) return x ^ y end

--- The remainder of a division, with the sign of x.
-- @api float result = mathx.mod(float x, float y)
function M.mod(x, y) return math.fmod(x, y) end

--- The decimal logarithm.
-- @api float result = mathx.log10(float x)
function M.log10(x) return math.log(x, 10) end

--- The hyperbolic cosine.
-- @api float result = mathx.cosh(float x)
function M.cosh(x) return (exp(x) + exp(-x)) / 2 end

--- The hyperbolic sine.
-- @api float result = mathx.sinh(float x)
function M.sinh(x) return (exp(x) - exp(-x)) / 2 end

--- x * 2^e.
-- @api float result = mathx.ldexp(float x, int e)
function M.ldexp(x, e) return x * 2.0 ^ e end

--- The length of the vector (x, y).
-- @api float result = mathx.hypot(float x, float y)
function M.hypot(x, y) return (x * x + y * y) ^ 0.5 end

--- The hyperbolic tangent.
-- @api float result = mathx.tanh(float x)
function M.tanh(x)
    if abs(x) > 20 then return x > 0 and 1.0 or -1.0 end -- exp would overflow
    local e = exp(2 * x)
    return (e - 1) / (e + 1)
end

--- x = m * 2^e with 0.5 <= |m| < 1.
-- @api float m, int e = mathx.frexp(float x)
function M.frexp(x)
    if x == 0 or x ~= x or abs(x) == math.huge then return x, 0 end
    local e = floor(math.log(abs(x), 2)) + 1
    local m = x / 2.0 ^ e
    if abs(m) >= 1 then m, e = m / 2, e + 1 elseif abs(m) < 0.5 then m, e = m * 2, e - 1 end
    return m, e
end

--- -1, 0 or 1.
-- @api int result = mathx.sign(float x)
function M.sign(x) return x > 0 and 1 or x < 0 and -1 or 0 end

--- The median of a list of numbers.
-- @api float result = mathx.median(float[] t)
function M.median(t)
    local sorted = table.move(t, 1, #t, 1, {})
    table.sort(sorted)
    local middle = (#sorted + 1) // 2
    if #sorted % 2 == 1 then return sorted[middle] end
    return (sorted[middle] + sorted[middle + 1]) / 2
end

-- The generator of the script (sim.getRandom): same numbers in every run.
local function scriptRandom(...)
    local sim = _quietRequire 'sim'
    return sim.getRandom(...)
end

--- Like math.random, on the generator of sim.getRandom.
-- @api float result = mathx.random2(int low = nil, int high = nil)
function M.random2(low, high)
    local x = scriptRandom()
    if low == nil then return x end
    if high == nil then low, high = 1, low end
    return low + floor(x * (high - low + 1))
end

--- Seeds the generator of sim.getRandom.
-- @api mathx.randomseed2(int seed)
function M.randomseed2(seed) scriptRandom(seed) end

return M
