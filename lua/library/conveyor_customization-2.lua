--[[
Earlier name of models.conveyor_customization-3, for scripts that belong to their model itself.
]]

return require 'models.conveyor_customization-3'
