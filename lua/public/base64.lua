--[[
Base 64 of bytes (RFC 4648). Functions accept strings and buffers and return buffers.
]]

local base64 = {}

local ALPHABET <const> = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/'
local char, byte = string.char, string.byte

local letters, values = {}, {['-'] = 62, ['_'] = 63}
for i = 0, 63 do
    letters[i] = ALPHABET:sub(i + 1, i + 1)
    values[letters[i]] = i
end

--- The base-64 form of some bytes.
-- @api buffer encoded = base64.encode(buffer data)
function base64.encode(data)
    data = tostring(data)
    local missing = -#data % 3
    local encoded = (data .. ('\0'):rep(missing)):gsub('...', function(group)
        local a, b, c = byte(group, 1, 3)
        local bits = a << 16 | b << 8 | c
        return letters[bits >> 18] .. letters[bits >> 12 & 63] .. letters[bits >> 6 & 63] .. letters[bits & 63]
    end)
    return tobuffer(encoded:sub(1, #encoded - missing) .. ('='):rep(missing))
end

--- The bytes of base-64 text. Also accepts the URL alphabet, white space and missing padding; other characters are an error.
-- @api buffer data = base64.decode(buffer encoded)
function base64.decode(encoded)
    local text = tostring(encoded):gsub('%s+', ''):gsub('=?=?$', '')
    local missing = -#text % 4
    if missing == 3 or text:find('[^%w+/_-]') then error('base64: not base 64', 2) end
    local data = (text .. ('A'):rep(missing)):gsub('(.)(.)(.)(.)', function(a, b, c, d)
        local bits = values[a] << 18 | values[b] << 12 | values[c] << 6 | values[d]
        return char(bits >> 16, bits >> 8 & 255, bits & 255)
    end)
    return tobuffer(data:sub(1, #data - missing))
end

return base64
