--[[
Matrices and vectors. Loading this makes Matrix, Vector, Vector3, Vector4, Vector7, Matrix3x3 and Matrix4x4 global.

    Matrix{{1, 2}, {3, 4}}, Matrix(rows, cols, data)    data: numbers by rows, one number, f(i, j), or nothing for zeros
    Vector{1, 2, 3}, Vector(length, data)               columns; Vector3{x, y, z}, Matrix4x4(data) and so on check the size
    m[i], m[i][j], m[i] = x, #m                         a row (shared, not copied), or an element of a vector
    a * b                                               product of matrices; with a number: of each element
    a + b, a - b, a / b, a // b, a % b, a ^ b, -a       element by element, with a matrix or a number
    a .. b, a == b                                      beside each other; equal in shape and all elements

    shape       rows cols count sameshape offset get set item setitem row rowref setrow col setcol slice flip droprow dropcol at
                horzcat vertcat assign repmat copy data dataref totable fromtable eye ones zeros print
    elements    applyfunc applyfuncidx applyfunc2 binop abs acos asin atan ceil cos deg exp floor fmod log rad random sin sqrt tan
                tointeger ult add sub times div idiv mod pow eq ne lt gt le ge isnan where nonzero
    overall     fold sum prod mean min max (of all; dim 1: of each column; 2: of each row), all any
    algebra     t mul mult dot cross kron hom nonhom norm normalized diag trace axis power gauss det inv svd pinv
    vectors     Vector:range linspace logspace geomspace; Vector3:hom random unitrandom; Vector4:hom
    rotations   Matrix3x3:rotx roty rotz fromquaternion fromeuler fromaxisangle toquaternion toeuler random isorthonormal
    poses       Matrix4x4:fromrotation fromquaternion fromeuler fromposition fromrt frompose torotation toquaternion toeuler
                toposition topose inv random

As CBOR a matrix is tag 40 on {{rows, columns}, numbers}.
]]

Matrix = require 'matrix.core'
require 'matrix.maths'
require 'matrix.linear'
local space = require 'matrix.space'
Vector, Vector3, Vector4, Vector7 = space.Vector, space.Vector3, space.Vector4, space.Vector7
Matrix3x3, Matrix4x4 = space.Matrix3x3, space.Matrix4x4

return Matrix
