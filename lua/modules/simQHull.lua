--[[
Convex hulls, by the functions of simConvex.
]]

local simConvex = require 'simConvex'
local simQHull = {}

--- The convex hull of points.
-- @api float[] vertices, int[] indices = simQHull.compute(float[] vertices, bool generateIndices)
-- @param vertices three coordinates each
-- @param generateIndices whether the triangles are wanted
-- @return vertices those of the corners
-- @return indices three of each triangle, from 0; empty if they are not wanted
function simQHull.compute(vertices, generateIndices)
    local corners, triangles = simConvex.qhull(vertices)
    return corners, generateIndices and triangles or {}
end

--- The convex hull of objects, as a new shape.
-- @api int resultShapeHandle = simQHull.computeShape(int[] handles)
-- @param handles shapes and other objects with points
-- @return resultShapeHandle the shape
function simQHull.computeShape(handles) return simConvex.hull(handles) end

return simQHull
