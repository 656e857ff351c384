--[[
The later name of the module matrix.
]]

return require 'matrix'
