-- as: sandbox
-- passes: 0
-- spec: poses 3, poses 1, threads 2, properties 4; parameters in older forms, angles converted both ways
-- tol: 1e-6
-- topic: old functions
sim = require 'sim'

-- Both kinds of angles mean the same rotation: Rx(alpha) Ry(beta) Rz(gamma) = Rz(yaw) Ry(pitch) Rx(roll).
local function rotation(...)
    local m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}
    for _, angles in ipairs{...} do m = sim.multiplyMatrices(m, sim.buildMatrix({0, 0, 0}, angles)) end
    return m
end
local function differ(a, b)
    local worst = 0
    for i = 1, 12 do worst = math.max(worst, math.abs(a[i] - b[i])) end
    return worst > 1e-9
end
local function ofYawPitchRoll(yaw, pitch, roll) return rotation({0, 0, yaw}, {0, pitch, 0}, {roll, 0, 0}) end
local wrong = 0
for _, a in ipairs{-3, -1.2, 0, 0.4, 2.5} do
    for _, b in ipairs{-1.4, -0.3, 0, 0.9, 1.5} do
        for _, c in ipairs{-2.9, -0.7, 0, 1.1, 3.1} do
            if differ(rotation{a, b, c}, ofYawPitchRoll(sim.alphaBetaGammaToYawPitchRoll(a, b, c))) then wrong = wrong + 1 end
            if differ(ofYawPitchRoll(a, b, c), rotation{sim.yawPitchRollToAlphaBetaGamma(a, b, c)}) then wrong = wrong + 1 end
        end
    end
end
print('different rotations', wrong)

-- Where two axes coincide, all of the rotation about them is the roll, or the alpha.
local H <const> = math.pi / 2
for _, angles in ipairs{{0.4, H, 0.4}, {0.4, -H, -0.4}, {-2, H, -2}, {-2, -H, 2}, {0.4, H, 0.3}} do
    local alpha, beta, gamma = sim.yawPitchRollToAlphaBetaGamma(table.unpack(angles))
    print('the same', not differ(ofYawPitchRoll(table.unpack(angles)), rotation{alpha, beta, gamma}), gamma)
end
for _, angles in ipairs{{0.4, H, -0.4}, {0.4, -H, 0.4}, {-2, H, 2}, {-2, -H, -2}, {0.4, H, 0.3}} do
    local yaw, pitch, roll = sim.alphaBetaGammaToYawPitchRoll(table.unpack(angles))
    print('the same', not differ(rotation(angles), ofYawPitchRoll(yaw, pitch, roll)), yaw)
end
for _, angles in ipairs{{0, -H, 0}, {0, -H, 0.5}, {0, H, 0.5}} do print('to yaw, pitch, roll', sim.alphaBetaGammaToYawPitchRoll(sim.yawPitchRollToAlphaBetaGamma(table.unpack(angles)))) end
for _, angles in ipairs{{0.5, H, 0}, {0.5, -H, 0}} do print('to alpha, beta, gamma', sim.yawPitchRollToAlphaBetaGamma(sim.alphaBetaGammaToYawPitchRoll(table.unpack(angles)))) end

-- Named parameters and settings.
for _, entry in ipairs{{'true', true}, {'1', true}, {'ON', true}, {'Yes', true}, {'false', false}, {'0', false}, {'something', false}} do
    sim.setNamedStringParam('test', entry[1])
    print(entry[1], sim.getNamedBoolParam('test') == entry[2])
end
print('none', sim.getNamedBoolParam('nobody'), pcall(sim.getNamedFloatParam, 'nobody'))
sim.setNamedBoolParam('test', true)
print(sim.getNamedStringParam('test'))
sim.setNamedBoolParam('test', false)
print(sim.getNamedStringParam('test'))
sim.setNamedFloatParam('test', 0.25)
print(sim.getNamedStringParam('test'), sim.getNamedFloatParam('test'), sim.getNamedInt32Param('test'))
sim.setNamedInt32Param('test', -7)
print(sim.getNamedStringParam('test'), sim.getNamedFloatParam('test'), sim.getNamedInt32Param('test'))
for _, entry in ipairs{{'text', 'abc'}, {'number', '2.5'}, {'whole', '12'}, {'switch', 'on'}} do sim.setNamedStringParam('settings.' .. entry[1], entry[2]) end
print(sim.getSettingString('text'), sim.getSettingFloat('number'), sim.getSettingInt32('whole'), sim.getSettingBool('switch'), sim.getSettingBool('text'))
print('none', sim.getSettingString('nobody'), sim.getSettingBool('nobody'))

-- Parameters of objects, with a result first.
local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.5, 1, 1})
print(sim.getObjectFloatParameter(box, sim.objfloatparam_objbbox_max_x))
print(sim.getObjectInt32Parameter(box, sim.objintparam_visibility_layer))
print(sim.getObjectFloatParameter(box, 99999))
print(sim.getObjectInt32Parameter(box, 99999))

-- Time slices: whole milliseconds, read a thousand times too large.
for _, ms in ipairs{3, 1, 29} do
    sim.setThreadSwitchTiming(ms)
    print(ms, sim.getThreadSwitchTiming())
end
sim.setThreadSwitchTiming(2)
print(sim.getIsRealTimeSimulation(), sim.getRealTimeSimulation())
sim.setBoolParam(sim.boolparam_realtime_simulation, true)
print(sim.getIsRealTimeSimulation(), sim.getRealTimeSimulation())
sim.setBoolParam(sim.boolparam_realtime_simulation, false)

local original = {1, {2, x = {3}}}
local copy = sim.copyTable(original)
print(copy[2] ~= original[2], copy[2].x ~= original[2].x, copy[2].x[1])
