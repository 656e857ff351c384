--[[
Inverting matrices and poses in place, as scripts before 4.3 do.

The maths is native: sim.getMatrixInverse, sim.getPoseInverse.
]]

local sim = ...
local M = {}

--- Inverts a matrix in place.
-- @api int result = sim.invertMatrix(float[12] matrix)
-- @param matrix is changed
-- @return result 1
function M.invertMatrix(matrix)
    table.move(sim.getMatrixInverse(matrix), 1, 12, 1, matrix)
    return 1
end

--- Inverts a pose in place.
-- @api int result = sim.invertPose(float[7] pose)
-- @param pose is changed
-- @return result 1
function M.invertPose(pose)
    table.move(sim.getPoseInverse(pose), 1, 7, 1, pose)
    return 1
end

return M
