--[[
Random identifiers: 'xxxxxxxx-xxxx-4xxx-yxxx-xxxxxxxxxxxx' (RFC 9562).

Calling the module is v4. Without set_rng it uses rng.math_random(), which draws from the generator of the script, so that runs can be repeated.
]]

local uuid = {rng = {}}

function uuid.rng.math_random()
    local random = _quietRequire('sim').getRandom
    return function(n)
        local bytes = {}
        for i = 1, n do bytes[i] = string.char(math.min(255, math.floor(random() * 256))) end
        return table.concat(bytes)
    end
end

local generate

--- Sets the generator: f(n) returns a string of n random bytes.
-- @api uuid.set_rng(func f)
function uuid.set_rng(f) generate = f end

--- A random identifier.
-- @api string id = uuid.v4()
function uuid.v4()
    generate = generate or uuid.rng.math_random()
    local bytes = {generate(16):byte(1, 16)}
    if #bytes ~= 16 then error('uuid: the generator gave fewer than 16 bytes', 2) end
    bytes[7] = bytes[7] & 0x0f | 0x40
    bytes[9] = bytes[9] & 0x3f | 0x80
    return (('%02x'):rep(4) .. ('-' .. ('%02x'):rep(2)):rep(3) .. '-' .. ('%02x'):rep(6)):format(table.unpack(bytes))
end

return setmetatable(uuid, {__call = function() return uuid.v4() end})
