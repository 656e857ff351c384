--[[
Old functions of sim that scripts still use, based on the new ones.

Deprecation notices and plain aliases are native.
]]

local sim = ...
local M = {}

--- Copy of a table, tables inside included.
-- @api any[] copy = sim.copyTable(any[] original)
-- @param original table
-- @return copy shares nothing with the original
function M.copyTable(original)
    local copy = require('tablex.functions').deepcopy(original)
    return copy
end

--- Sets how long a thread may run before it is interrupted.
-- @api sim.setThreadSwitchTiming(int milliseconds)
-- @param milliseconds whole
function M.setThreadSwitchTiming(milliseconds)
    sim.setAutoYieldDelay((milliseconds + 0.001) / 1000) -- the delay is cut to whole milliseconds
end

--- The time slice of a thread.
-- @api float value = sim.getThreadSwitchTiming()
-- @return value milliseconds times 1000, as in 4.10
function M.getThreadSwitchTiming() return sim.getAutoYieldDelay() * 1000 end

--- Whether the simulation runs in real time.
-- @api int result = sim.getIsRealTimeSimulation()
-- @return result 1 or 0
function M.getIsRealTimeSimulation() return sim.getBoolParam(sim.boolparam_realtime_simulation) and 1 or 0 end

--- Whether the simulation runs in real time.
-- @api bool result = sim.getRealTimeSimulation()
-- @return result
function M.getRealTimeSimulation() return sim.getBoolParam(sim.boolparam_realtime_simulation) end

--- Whether a function or constant is deprecated; 4.10 does not know.
-- @api int result = sim.isDeprecated(string funcOrConst)
-- @param funcOrConst its name
-- @return result 0
function M.isDeprecated(funcOrConst) return 0 end

---------------------------------------------------------------- Euler angles

local ANGLES = {{type = 'float'}, {type = 'float'}, {type = 'float'}}

--- From the angles of sim.getObjectOrientation to yaw, pitch and roll.
-- @api float yaw, float pitch, float roll = sim.alphaBetaGammaToYawPitchRoll(float alpha, float beta, float gamma)
-- @param alpha about x, first
-- @param beta about the new y
-- @param gamma about the new z
-- @return yaw about z, first
-- @return pitch about the new y
-- @return roll about the new x
function M.alphaBetaGammaToYawPitchRoll(...)
    local alpha, beta, gamma = require('checkargs.check')(ANGLES, ...)
    local sa, ca, sb, cb = math.sin(alpha), math.cos(alpha), math.sin(beta), math.cos(beta)
    local sg, cg = math.sin(gamma), math.cos(gamma)
    local r31 = sa * sg - ca * sb * cg
    if math.abs(r31) > 0.999999 then -- roll and yaw turn about the same axis: all of it is called roll
        return 0, r31 < 0 and math.pi / 2 or -math.pi / 2, math.atan(sa * cb, ca * cg - sa * sb * sg)
    end
    local yaw = math.atan(ca * sg + sa * sb * cg, cb * cg)
    return yaw, math.asin(-r31), math.atan(sa * cg + ca * sb * sg, ca * cb)
end

--- From yaw, pitch and roll to the angles of sim.getObjectOrientation.
-- @api float alpha, float beta, float gamma = sim.yawPitchRollToAlphaBetaGamma(float yaw, float pitch, float roll)
-- @param yaw about z, first
-- @param pitch about the new y
-- @param roll about the new x
-- @return alpha about x, first
-- @return beta about the new y
-- @return gamma about the new z
function M.yawPitchRollToAlphaBetaGamma(...)
    local yaw, pitch, roll = require('checkargs.check')(ANGLES, ...)
    local sy, cy, sp, cp = math.sin(yaw), math.cos(yaw), math.sin(pitch), math.cos(pitch)
    local sr, cr = math.sin(roll), math.cos(roll)
    local r13 = sy * sr + cy * sp * cr
    if math.abs(r13) > 0.999999 then -- alpha and gamma turn about the same axis: all of it is called alpha
        return math.atan(cp * sr, cy * cr + sy * sp * sr), r13 > 0 and math.pi / 2 or -math.pi / 2, 0.0
    end
    local alpha = math.atan(cy * sr - sy * sp * cr, cp * cr)
    return alpha, math.asin(r13), math.atan(sy * cr - cy * sp * sr, cy * cp)
end

---------------------------------------------------------------- named parameters and settings

local function boolOf(text)
    if text == nil then return nil end
    text = tostring(text):lower()
    return text == 'true' or text == '1' or text == 'on' or text == 'yes'
end

local function setting(key)
    return sim.getStringProperty(sim.handle_app, 'namedParam.settings.' .. key, {noError = true})
end

--- Named parameter as a boolean.
-- @api bool value = sim.getNamedBoolParam(string name)
-- @param name of the parameter
-- @return value nil if there is none
function M.getNamedBoolParam(name) return boolOf(sim.getNamedStringParam(name)) end

--- Named parameter as a float.
-- @api float value = sim.getNamedFloatParam(string name)
-- @param name of the parameter
-- @return value nil if there is none
function M.getNamedFloatParam(name) return tonumber(sim.getNamedStringParam(name)) end

--- Named parameter as an integer.
-- @api int value = sim.getNamedInt32Param(string name)
-- @param name of the parameter
-- @return value nil if there is none
function M.getNamedInt32Param(name) return math.tointeger(tonumber(sim.getNamedStringParam(name))) end

--- Sets a named parameter from a boolean.
-- @api sim.setNamedBoolParam(string name, bool value)
-- @param name of the parameter
-- @param value stored as text
function M.setNamedBoolParam(name, value) sim.setNamedStringParam(name, value and 'true' or 'false') end

--- Sets a named parameter from a float.
-- @api sim.setNamedFloatParam(string name, float value)
-- @param name of the parameter
-- @param value stored as text
function M.setNamedFloatParam(name, value) sim.setNamedStringParam(name, tostring(value)) end

--- Sets a named parameter from an integer.
-- @api sim.setNamedInt32Param(string name, int value)
-- @param name of the parameter
-- @param value stored as text
function M.setNamedInt32Param(name, value) sim.setNamedStringParam(name, tostring(value)) end

--- User setting as a boolean.
-- @api bool value = sim.getSettingBool(string key)
-- @param key of the setting
-- @return value nil if there is none
function M.getSettingBool(key) return boolOf(setting(key)) end

--- User setting as a float.
-- @api float value = sim.getSettingFloat(string key)
-- @param key of the setting
-- @return value nil if there is none
function M.getSettingFloat(key) return tonumber(setting(key)) end

--- User setting as an integer.
-- @api int value = sim.getSettingInt32(string key)
-- @param key of the setting
-- @return value nil if there is none
function M.getSettingInt32(key) return math.tointeger(tonumber(setting(key))) end

--- User setting as text.
-- @api string value = sim.getSettingString(string key)
-- @param key of the setting
-- @return value nil if there is none
function M.getSettingString(key) return setting(key) end

---------------------------------------------------------------- drawing

--- Shows points, as a drawing object: V-REP's point clouds were no objects of the scene.
-- @api int pointCloudHandle = sim.addPointCloud(int pageMask, int layerMask, int objectHandle, int options, float pointSize, float[] coordinates, int[] defaultColors = {}, int[] pointColors = {}, float[] pointNormals = {})
-- @param pageMask without effect
-- @param layerMask without effect
-- @param objectHandle the object the points belong to, or -1
-- @param options without effect
-- @param pointSize pixels
-- @param coordinates x, y, z of each, metres, in the world
-- @param defaultColors red, green, blue, 0 to 255; other values have no effect
-- @param pointColors without effect
-- @param pointNormals without effect
-- @return pointCloudHandle a drawing object: sim.removeDrawingObject removes it
function M.addPointCloud(pageMask, layerMask, objectHandle, options, pointSize, coordinates, defaultColors)
    local c = defaultColors or {}
    local colour = c[3] and {c[1] / 255, c[2] / 255, c[3] / 255} or nil
    local drawing = sim.addDrawingObject(sim.drawing_points, pointSize, 0, objectHandle, #coordinates // 3, colour)
    for i = 1, #coordinates - 2, 3 do
        sim.addDrawingObjectItem(drawing, {coordinates[i], coordinates[i + 1], coordinates[i + 2]})
    end
    return drawing
end

---------------------------------------------------------------- parameters of objects, with a result before the value

--- A floating-point parameter of an object.
-- @api int result, float parameter = sim.getObjectFloatParameter(int objectHandle, int parameterID)
-- @param objectHandle the object
-- @param parameterID as in sim.getObjectFloatParam
-- @return result 1, or 0 when there is no value
-- @return parameter the value
function M.getObjectFloatParameter(objectHandle, parameterID)
    local value = sim.getObjectFloatParam(objectHandle, parameterID)
    if value == nil then return 0 end
    return 1, value
end

--- An integer parameter of an object.
-- @api int result, int parameter = sim.getObjectInt32Parameter(int objectHandle, int parameterID)
-- @param objectHandle the object
-- @param parameterID as in sim.getObjectInt32Param
-- @return result 1, or 0 when there is no value
-- @return parameter the value
function M.getObjectInt32Parameter(objectHandle, parameterID)
    local value = sim.getObjectInt32Param(objectHandle, parameterID)
    if value == nil then return 0 end
    return 1, value
end

return M
