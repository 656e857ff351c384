--[[
Earlier name of models.efficientConveyor_customization-3, for scripts that belong to their model itself.
]]

return require 'models.efficientConveyor_customization-3'
