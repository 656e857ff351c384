--[[
Matrices, vectors, quaternions and poses. `simEigen = require 'simEigen'` has the classes Matrix, Vector, Quaternion and Pose, and the functions they are made of.

    Matrix(rows, cols, data), Matrix{{1, 2}, {3, 4}}, Vector{1, 2, 3}, Vector(size, value)
    m[i], m[i] = x, #m                              an element of a vector, a row of a matrix
    a + b, a - b, a / b, a // b, a % b, -a          element by element, with a matrix or a number
    a * b, a .. b, a == b                           product; side by side; equal in shape and numbers
    m:abs(), m:iabs()                               a new matrix, or the same one changed: abs acos asin atan ceil cos deg exp floor log log2 log10 rad sin sqrt tan
    m:add(x), m:iadd(x)                             with a number or a matrix: add sub times div intdiv mod min max; mul is the product
    rows cols count data setdata item setitem get set row col rowdata coldata setrow setcol setrowdata setcoldata block blockassign reshaped copy
    sum prod mean mincoeff maxcoeff trace norm squarednorm normalize normalized det dot cross kron t transpose transposed pinv svd
    horzcat vertcat transform inversetransform isorthogonal totable togrid tomatrix print
    Matrix: eye fromtable linspace random ismatrix isvector; Vector: random isvector tovector
    Quaternion{x, y, z, w}: data copy inv mul imul slerp axisangle toaxisangle toeuler toypr torotation tovector, a * b with a quaternion or a vector;
    Quaternion: fromaxisangle fromeuler fromypr fromrotation fromtwovectors random isquaternion toquaternion
    Pose(t, q), Pose{x, y, z, qx, qy, qz, qw}: t q data copy inv mul interp totransform tovector, a * b with a pose or a vector; Pose: fromtransform random ispose topose

Indices of the classes are from 1, those of the functions from 0. Numbers are listed by rows.
]]

local _, simEigen = ...

---------------------------------------------------------------- functions

--- A matrix of random numbers from -1 to 1.
-- @api string handle = simEigen.mtxRandom(int rows, int cols)
-- @param rows number of rows
-- @param cols number of columns
-- @return handle
function simEigen.mtxRandom(rows, cols)
    local handle = simEigen.mtxNew(rows, cols)
    local data = {}
    for i = 1, rows * cols do data[i] = 2 * math.random() - 1 end
    simEigen.mtxSetData(handle, data)
    return handle
end

--- A random rotation.
-- @api string handle = simEigen.quatRandom()
-- @return handle
function simEigen.quatRandom()
    -- Three random numbers, evenly over all rotations (Shoemake 1992).
    local u, v, w = math.random(), 2 * math.pi * math.random(), 2 * math.pi * math.random()
    local a, b = math.sqrt(1 - u), math.sqrt(u)
    return simEigen.quatNew{a * math.sin(v), a * math.cos(v), b * math.sin(w), b * math.cos(w)}
end

---------------------------------------------------------------- classes

require('simEigen.matrix')(simEigen)
require('simEigen.quaternion')(simEigen)
require('simEigen.pose')(simEigen)

---------------------------------------------------------------- functions of grids

local function grid(m) return m and m:togrid() end

--- Singular value decomposition of a grid, a table of dims and data.
-- @api table s, table u, table v, table x = simEigen.svd(table m, bool computeThinU = true, bool computeThinV = true, table b = nil)
-- @param m the grid
-- @param computeThinU whether u is wanted
-- @param computeThinV whether v is wanted
-- @param b right sides
-- @return s singular values
-- @return u
-- @return v
-- @return x solution, if there is b
function simEigen.svd(m, computeThinU, computeThinV, b)
    local Matrix = simEigen.Matrix
    local s, u, v, x = Matrix:fromtable(m):svd(computeThinU ~= false, computeThinV ~= false, b and Matrix:fromtable(b))
    return grid(s), grid(u), grid(v), grid(x)
end

--- Pseudo-inverse of a grid, a table of dims and data.
-- @api table m, table x = simEigen.pinv(table m, table b = nil, float damping = 0)
-- @param m the grid
-- @param b right sides
-- @param damping see mtxPInv
-- @return m the inverse
-- @return x solution, if there is b
function simEigen.pinv(m, b, damping)
    local Matrix = simEigen.Matrix
    local inverse, x = Matrix:fromtable(m):pinv(b and Matrix:fromtable(b), damping)
    return grid(inverse), grid(x)
end

return simEigen
