--[[
The dialogs and curves of graphs, which their customization scripts ask for. There is no display: nothing is shown and nothing recorded.
]]

return {}
