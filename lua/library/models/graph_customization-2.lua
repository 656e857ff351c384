--[[
Later name of graph_customization.
]]

return require 'graph_customization'
