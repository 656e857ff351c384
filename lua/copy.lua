--[[
Copies of tables, as a module of its own; the work is in tablex.
]]

local tablex = require 'tablex'

return {copy = tablex.clone, deepcopy = tablex.deepcopy}
