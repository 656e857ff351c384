--[[
Makes functions of sim accept and return objects of the module matrix: positions, angles and colours are Vector3, quaternions
Vector4, poses Vector7, matrices Matrix4x4, inertias Matrix3x3. Load it once; it returns sim.

Arguments may still be plain tables. A Matrix4x4 goes to sim as its first three rows.
]]

local sim = _quietRequire 'sim'
require 'matrix.globals' -- scripts find the classes as globals
local classes = require 'matrix-2'
local Matrix, Vector3, Vector4, Vector7 = classes.Matrix, classes.Vector3, classes.Vector4, classes.Vector7
local Matrix3x3, Matrix4x4 = classes.Matrix3x3, classes.Matrix4x4

local function homogeneous(data)
    return Matrix4x4(table.move({0, 0, 0, 1}, 1, 4, 13, table.move(data, 1, 12, 1, {})))
end

-- What the results are, by place; '-' for what stays as it is.
local RESULTS = {
    buildMatrix = 'M', buildMatrixQ = 'M', interpolateMatrices = 'M', rotateAroundAxis = 'M', getJointMatrix = 'M', getObjectMatrix = 'M',
    getObjectPosition = 'V', getObjectOrientation = 'V', getEulerAnglesFromMatrix = 'V', getObjectSizeValues = 'V',
    getObjectQuaternion = 'Q', getQuaternionFromMatrix = 'Q', getObjectPose = 'P', getRotationAxis = 'V',
    getObjectVelocity = 'VV', getVelocity = 'VV', getContactInfo = '-VVV', getLightParameters = '--VV', getShapeColor = '-V',
    getShapeMassAndInertia = '-IV', readForceSensor = '-VV',
    checkProximitySensor = '--V-V', checkProximitySensorEx = '--V-V', checkProximitySensorEx2 = '--VV',
    handleProximitySensor = '--V-V', readProximitySensor = '--V-V', getShapeGeomInfo = '--V',
}

-- Functions of which only the arguments change.
local TAKERS = {
    'addBanner', 'addDrawingObject', 'addForce', 'addForceAndTorque', 'addGhost', 'addParticleObject', 'auxiliaryConsoleOpen', 'createDummy',
    'createJoint', 'createPath', 'createPureShape', 'getClosestPositionOnPath', 'getConfigForTipPose', 'getDataOnPath', 'setLightParameters',
    'setObjectPose', 'setObjectMatrix', 'setObjectOrientation', 'setObjectPosition', 'setObjectQuaternion', 'setObjectSizeValues',
    'setShapeColor', 'setShapeMassAndInertia', 'setShapeTexture', 'setSphericalJointMatrix',
}

local KINDS = {M = homogeneous, V = Vector3, Q = Vector4, P = Vector7, I = Matrix3x3}
local SIZES = {M = 12, V = 3, Q = 4, P = 7, I = 9}

local function plain(value)
    if type(value) ~= 'table' or getmetatable(value) ~= Matrix then return value end
    local data = value:data()
    if value:rows() == 4 and value:cols() == 4 then return table.move(data, 1, 12, 1, {}) end
    return data
end

local function plainArguments(...)
    local arguments = table.pack(...)
    for i = 1, arguments.n do arguments[i] = plain(arguments[i]) end
    return table.unpack(arguments, 1, arguments.n)
end

local function objects(kinds, ...)
    local results = table.pack(...)
    for i = 1, math.min(#kinds, results.n) do
        local letter, value = kinds:sub(i, i), results[i]
        if KINDS[letter] and type(value) == 'table' and #value == SIZES[letter] then results[i] = KINDS[letter](value) end
    end
    return table.unpack(results, 1, results.n)
end

for name, kinds in pairs(RESULTS) do
    local original = sim[name]
    if original then sim[name] = function(...) return objects(kinds, original(plainArguments(...))) end end
end
for _, name in ipairs(TAKERS) do
    local original = sim[name]
    if original then sim[name] = function(...) return original(plainArguments(...)) end end
end

return sim
