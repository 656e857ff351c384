--[[
Another name of `luassert`.
]]

return require 'luassert'
