--[[
Shared by path_customization.lua: the line of a path in pictures, a drawing object that ends with the script (spec: models 2).
]]

local sim = _quietRequire 'sim'
local M = {}

local KIND <const> = sim.drawing_linestrip | sim.drawing_local | sim.drawing_followparentvisibility
local THICKNESS <const>, COLOUR <const> = 3, {0, 0.96, 0.66} -- pixels

local function colourOf(line)
    local colour = type(line.color) == 'table' and line.color or COLOUR
    local isColour = tonumber(colour[1]) and tonumber(colour[2]) and tonumber(colour[3])
    return isColour and {colour[1], colour[2], colour[3]} or COLOUR
end

--- Draws a path.
-- @param path the object
-- @param poses seven numbers per point, in the path's frame
-- @param line thickness (pixels) and color
-- @return the drawing object
function M.draw(path, poses, line)
    line = type(line) == 'table' and line or {}
    local count = #poses // 7
    local drawing = sim.addDrawingObject(KIND, tonumber(line.thickness) or THICKNESS, 0, path, count, colourOf(line))
    for i = 1, count do sim.addDrawingObjectItem(drawing, {poses[7 * i - 6], poses[7 * i - 5], poses[7 * i - 4]}) end
    return drawing
end

--- Removes a drawing object, if there is one.
function M.remove(drawing)
    if drawing then pcall(sim.removeDrawingObject, drawing) end
end

return M
