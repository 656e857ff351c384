--[[
Bytes as hexadecimal digits. Functions accept strings and buffers and return strings.
]]

local base16 = {}

--- The hexadecimal form of some bytes.
-- @api string encoded = base16.encode(buffer data)
function base16.encode(data)
    return (tostring(data):gsub('.', function(c) return ('%02x'):format(c:byte()) end))
end

--- The bytes of hexadecimal text. White space is skipped; other characters are an error.
-- @api string data = base16.decode(buffer encoded)
function base16.decode(encoded)
    local digits = tostring(encoded):gsub('%s+', '')
    if #digits % 2 == 1 or digits:find('%X') then error('base16: not pairs of hexadecimal digits', 2) end
    return (digits:gsub('%x%x', function(pair) return string.char(tonumber('0x' .. pair)) end))
end

return base16
