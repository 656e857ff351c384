--[[
Later name of path_customization.
]]

return require 'path_customization'
