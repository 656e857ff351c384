--[[
Later name of the module matrix.
]]

return require 'matrix'
