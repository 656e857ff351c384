--[[
Colours and looks of shapes, saved and restored as a whole; shapes of texts.

Does not draw; the values themselves are native.
]]

local sim = ...
local M = {}

local COLLECTIONS <const> = 2000000 -- handles from here on are collections
local COMPONENTS <const> = {0, 2, 3, 4} -- ambient and diffuse, specular, emission, transparency

local function shapesOf(entity)
    local objects = entity >= COLLECTIONS and sim.getCollectionObjects(entity) or {entity}
    local shapes = {}
    for _, object in ipairs(objects) do
        if sim.getObjectType(object) == sim.sceneobject_shape then shapes[#shapes + 1] = object end
    end
    return shapes
end

local CHANGE_ARGS = {{type = 'int'}, {type = 'table', item_type = 'float', size = 3}, {type = 'int', default = 0}}

--- Sets the colour of the shapes of a collection, or of one shape.
-- @api map[] originalColors = sim.changeEntityColor(int entityHandle, float[3] color, int component = sim.colorcomponent_ambient_diffuse)
-- @param entityHandle shape or collection
-- @param color red, green, blue
-- @param component sim.colorcomponent_*
-- @return originalColors for sim.restoreEntityColor
function M.changeEntityColor(...)
    local entity, color, component = require('checkargs.check')(CHANGE_ARGS, ...)
    local saved = {}
    for i, shape in ipairs(shapesOf(entity)) do
        local _, data = sim.getShapeColor(shape, '@compound', component)
        saved[i] = {handle = shape, comp = component, data = data}
        sim.setShapeColor(shape, nil, component, color)
    end
    return saved
end

--- Undoes sim.changeEntityColor.
-- @api sim.restoreEntityColor(map[] originalColors)
-- @param originalColors from sim.changeEntityColor; objects that are gone are left out
function M.restoreEntityColor(...)
    local saved = require('checkargs.check')({{type = 'table'}}, ...)
    for _, entry in ipairs(saved) do
        if sim.isHandle(entry.handle) then sim.setShapeColor(entry.handle, '@compound', entry.comp, entry.data) end
    end
end

local function flagOf(shape, parameter) return sim.getObjectInt32Param(shape, parameter) end

--- The appearance of a shape.
-- @api map appearance = sim.getShapeAppearance(int handle, map options = {})
-- @param handle the shape
-- @return appearance for sim.setShapeAppearance
function M.getShapeAppearance(handle)
    local appearance = {
        edges = flagOf(handle, sim.shapeintparam_edge_visibility),
        wireframe = flagOf(handle, sim.shapeintparam_wireframe),
        visibility = flagOf(handle, sim.objintparam_visibility_layer),
        colors = {},
    }
    for i, component in ipairs(COMPONENTS) do
        local _, data = sim.getShapeColor(handle, '@compound', component)
        appearance.colors[i] = {comp = component, data = data}
    end
    return appearance
end

--- Makes a shape look like another one did.
-- @api int handle = sim.setShapeAppearance(int handle, map appearance, map options = {})
-- @param handle the shape
-- @param appearance from sim.getShapeAppearance
-- @return handle the shape
function M.setShapeAppearance(handle, appearance)
    sim.setObjectInt32Param(handle, sim.shapeintparam_edge_visibility, appearance.edges)
    sim.setObjectInt32Param(handle, sim.shapeintparam_wireframe, appearance.wireframe)
    sim.setObjectInt32Param(handle, sim.objintparam_visibility_layer, appearance.visibility)
    for _, color in ipairs(appearance.colors) do
        local _, own = sim.getShapeColor(handle, '@compound', color.comp)
        local fits = own and color.data and #own == #color.data
        local width = color.comp == sim.colorcomponent_transparency and 1 or 3
        if fits then
            sim.setShapeColor(handle, '@compound', color.comp, color.data)
        elseif color.data then
            sim.setShapeColor(handle, nil, color.comp, table.move(color.data, 1, width, 1, {}))
        end
    end
    return handle
end

local TEXT_ARGS <const> = {
    {type = 'string'}, {type = 'table', item_type = 'float', size = 3, default = {1, 1, 1}}, {type = 'float', default = 0.1},
    {type = 'bool', default = false}, {type = 'string', default_nil = true},
}

--- Makes a model of the letters of a text. They are strokes of our own.
-- @api int modelHandle = sim.generateTextShape(string txt, float[3] color = {1, 1, 1}, float height = 0.1, bool centered = false, string alphabetLocation = nil)
-- @param txt with line ends
-- @param height of a capital letter
-- @param centered the middle of each line is at x = 0
-- @param alphabetLocation has no effect
-- @return modelHandle a dummy with the shape
function M.generateTextShape(...)
    local text, color, height, centered = require('checkargs.check')(TEXT_ARGS, ...)
    return (require('textUtils').generateTextShape(text, color, height, centered))
end

return M
