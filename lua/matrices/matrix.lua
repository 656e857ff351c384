--[[
Matrices and vectors. Loading this makes Matrix, Vector, Vector3, Vector4, Vector7, Matrix3x3 and Matrix4x4 global; it returns nothing.

They are the classes of matrix-2. CoppeliaSim has deprecated this module in favour of simEigen, and says so when it is loaded.
]]

require 'matrix.globals'
