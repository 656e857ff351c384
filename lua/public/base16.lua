--[[
Bytes as hexadecimal digits: encode(data), decode(encoded).

Takes strings and buffers, gives strings. decode takes small and capital digits and skips white space; anything else is an error.
]]

local base16 = {}

function base16.encode(data)
    return (tostring(data):gsub('.', function(c) return ('%02x'):format(c:byte()) end))
end

function base16.decode(encoded)
    local digits = tostring(encoded):gsub('%s+', '')
    if #digits % 2 == 1 or digits:find('%X') then error('base16: not pairs of hexadecimal digits', 2) end
    return (digits:gsub('%x%x', function(pair) return string.char(tonumber('0x' .. pair)) end))
end

return base16
