--[[
What path_customization is, by its later name.
]]

return require 'path_customization'
