--[[
Bytes as hexadecimal digits, in capitals. Functions accept strings and buffers and return strings.
]]

local base16 = {}

--- The hexadecimal form of some bytes.
-- @api string encoded = base16.encode(buffer data)
function base16.encode(data)
    return (tostring(data):gsub('.', function(c) return ('%02X'):format(c:byte()) end))
end

--- The bytes of hexadecimal text. White space is skipped; the last digit of an odd number of them is a byte by itself; other characters are an error.
-- @api string data = base16.decode(buffer encoded)
function base16.decode(encoded)
    local digits = tostring(encoded):gsub('%s+', '')
    if digits:find('%X') then error('base16: not hexadecimal digits', 2) end
    local bytes = {}
    for pair in digits:gmatch('..?') do bytes[#bytes + 1] = string.char(tonumber('0x' .. pair)) end
    return table.concat(bytes)
end

return base16
