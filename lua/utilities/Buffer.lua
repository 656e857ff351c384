--[[
The class of byte buffers, those of tobuffer and of functions that give data.

    Buffer(text)                      the same as tobuffer(text)
    Buffer.isbuffer(o), Buffer.tobuffer(o)

A buffer has the functions of strings, a length, ==, .. and tostring; as CBOR it is a byte string.
]]

-- The metatable all buffers share, made in base.lua.
local Buffer = getmetatable(tobuffer(''))

local class = {name = 'Buffer', isbuffer = isbuffer, tobuffer = tobuffer, static = {isbuffer = isbuffer, tobuffer = tobuffer}}

-- Gives a buffer its bytes.
function class.initialize(buffer, text) rawset(buffer, '__buff__', tostring(text or '')) end

function class.new(_, text) return tobuffer(text or '') end

return setmetatable(class, {__index = Buffer, __call = class.new, __tostring = function() return 'class Buffer' end})
