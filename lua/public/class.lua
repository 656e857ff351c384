--[[
The name some scripts load middleclass by.
]]

return require 'middleclass'
