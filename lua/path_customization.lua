--[[
The dialogs and shapes of paths, which their customization scripts ask for. There is no display: a path keeps the points it was saved
with, and its script may define `shaping` in the table this returns.
]]

return {}
