--[[
The low-level filters of `mime`: b64, unb64, qp, unqp, wrp, qpwrp, eol, dot.
]]

local _, native = ...

local core = {_VERSION = 'MIME 1.0.3'}
for name, f in pairs(native) do core[name] = f end

return core
