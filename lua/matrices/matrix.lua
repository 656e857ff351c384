--[[
Matrices and vectors. Loading this makes Matrix, Vector, Vector3, Vector4, Vector7, Matrix3x3 and Matrix4x4 global; it returns nothing.

They are the classes of matrix-2. CoppeliaSim has deprecated this module in favour of simEigen, and says so when it is loaded.
]]

for name, class in pairs(require 'matrix-2') do _G[name] = class end

addLog(430, '"matrix" module is deprecated. please use simEigen') -- sim.verbosity_scriptwarnings; sim may not be loaded
