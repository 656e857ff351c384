--[[
Properties that are matrices in CoppeliaSim 4.11, where 4.10 has a list of numbers.

Values of other properties are not looked at: the error names the function that reads them.
]]

local sim = ...
local M = {}

-- Name of the property in 4.10, and the length of a row; nothing: that of a picture of the sensor.
local MATRICES <const> = {
    vertices = {'vertices', 3}, normals = {'normals', 3}, points = {'points', 3},
    inertiaMatrix = {'inertia', 3}, depth = {'depthBuffer'},
}

local function property(name)
    local known = MATRICES[name]
    if not known then error("no property with a matrix: '" .. tostring(name) .. "' (sim.getProperty reads all others)", 3) end
    return table.unpack(known)
end

--- Value of a property that CoppeliaSim 4.11 has as a matrix: vertices, normals, points, inertiaMatrix, depth.
-- @api simEigen.Matrix matrix = sim.getMatrixProperty(int target, string name, map options = {})
-- @param target mesh, shape, vision sensor, point cloud or octree
-- @param name of the property
-- @param options noError: nil if the target has no such property
-- @return matrix one row for each vertex, normal, point or row of pixels
function M.getMatrixProperty(target, name, options)
    local known, columns = property(name)
    local values = sim.getFloatArrayProperty(target, known, options)
    if not values then return nil end
    columns = columns or sim.getVisionSensorRes(target)[1]
    return require 'simEigen'.Matrix(#values // columns, columns, values)
end

--- Sets a property that CoppeliaSim 4.11 has as a matrix: inertiaMatrix.
-- @api sim.setMatrixProperty(int target, string name, simEigen.Matrix matrix)
-- @param target shape
-- @param name of the property
-- @param matrix of 3 by 3
function M.setMatrixProperty(target, name, matrix) sim.setFloatArrayProperty(target, (property(name)), matrix:data()) end

return M
