--[[
Earlier name of models.conveyorSystem_customization-3, for scripts that belong to their model itself.
]]

return require 'models.conveyorSystem_customization-3'
