-- topic: errors
-- as: sandbox
-- passes: 0
-- spec: conventions 3
-- note: lines of scene/x-errors-more, which has others that are meant to differ: the texts of the original for arguments of a wrong type
sim = require 'sim'
local function tail(name, ...)
    local _, e = pcall(sim[name], ...)
    print((tostring(e):match 'in (sim%.[%w_]+: .*)$' or tostring(e)))
end
for _, name in ipairs {'buildMatrix', 'buildPose', 'multiplyMatrices', 'multiplyPoses', 'multiplyVector', 'getRotationAxis', 'addForceAndTorque', 'relocateShapeFrame', 'generateShapeFromPath', 'createPrimitiveShape'} do tail(name, 1, 2) end
for _, name in ipairs {'getEulerAnglesFromMatrix', 'getMatrixInverse', 'poseToMatrix', 'matrixToPose', 'groupShapes'} do tail(name, 'x') end
tail('groupShapes', {})
tail('broadcastMsg')
tail('getShapeBB', 'x')
tail('getShapeColor', 'x')
tail('initScript', 'x')
tail('resetDynamicObject', {})
tail('loadModel', {})
tail('loadModel', 1)
