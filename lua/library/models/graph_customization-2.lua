--[[
What graph_customization is, by its later name.
]]

return require 'graph_customization'
