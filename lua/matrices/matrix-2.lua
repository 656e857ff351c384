--[[
The classes of matrices and vectors, in a table: Matrix, Vector, Vector3, Vector4, Vector7, Matrix3x3, Matrix4x4.

    local Matrix = require('matrix-2').Matrix

    Matrix{{1, 2}, {3, 4}}, Matrix(rows, cols, data)    data: numbers by rows, one number, f(i, j), or nothing for zeros
    Vector{1, 2, 3}, Vector(length, data)               columns; Vector3{x, y, z}, Matrix4x4(data) and so on check the size
    m[i], m[i][j], m[i] = x, #m                         a row (shared, not copied), or an element of a vector
    a * b                                               product of matrices; with a number: of each element
    a + b, a - b, a / b, a // b, a % b, a ^ b, -a       element by element, with a matrix or a number
    a == b                                              equal in shape and all elements

As CBOR a matrix is tag 40 on {{rows, columns}, numbers}.
]]

local Matrix = require 'matrix.core'
require 'matrix.maths'
require 'matrix.linear'
local space = require 'matrix.space'

return {
    Matrix = Matrix, Vector = space.Vector, Vector3 = space.Vector3, Vector4 = space.Vector4, Vector7 = space.Vector7,
    Matrix3x3 = space.Matrix3x3, Matrix4x4 = space.Matrix4x4,
}
