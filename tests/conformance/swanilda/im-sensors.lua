-- topic: simIM
-- as: sandbox
-- passes: 0
-- spec: simim 1, simim 2, sensors 3
-- Images of sensors, textures and files, and markers.
sim = require 'sim'
simIM = require 'simIM'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local s = sim.createVisionSensor(1 + 2 + 16, {2, 2, 0, 0}, {0.1, 10, 1, 0.02, 0, 0, 0, 0, 0, 0, 0})
sim.setVisionSensorImg(s, 'abcdefghijkl')
local im = simIM.readFromVisionSensor(s)
print(simIM.size(im), simIM.get(im, {0, 0}), simIM.get(im, {1, 1}))
simIM.set(im, {0, 0}, {49, 50, 51})
simIM.writeToVisionSensor(im, s)
print(tostring((sim.getVisionSensorImg(s))))
print(simIM.readFromVisionSensor(s, im) == im)
e(simIM.writeToVisionSensor, simIM.create(3, 3), s)
e(simIM.writeToVisionSensor, simIM.create(2, 2, simIM.format._8UC1), s)
e(simIM.readFromVisionSensor, sim.createDummy(0.1))
e(simIM.readFromVisionSensor, 123456)

-- a script of the sensor works on the image
local script = sim.createScript(sim.scripttype_customization, [[
    sim = require 'sim'
    simIM = require 'simIM'
    simVision = require 'simVision'
    function sysCall_vision(data)
        local im = simIM.readFromVisionSensor(data.handle)
        simIM.bitwiseNot(im, true)
        simIM.writeToVisionSensor(im, data.handle)
        simIM.destroy(im)
        simVision.sensorImgToWorkImg(sim.handle_self)
        simVision.horizontalFlipWorkImg(sim.handle_self)
        simVision.workImgToSensorImg(sim.handle_self)
        return {trigger = true, packedPackets = {sim.packFloatTable {1, 2}, 5, ''}}
    end
]])
sim.setObjectParent(script, s)
sim.initScript(script)
sim.setVisionSensorImg(s, '\255\255\255\254\253\252\0\0\0\0\0\0')
print(tostring((sim.getVisionSensorImg(s))):byte(1, 12))
local result, _, second, third = sim.readVisionSensor(s)
print(result, second, third)

-- files and textures
local file = simIM.encode(im, 'PNG')
print(type(file), file:sub(2, 4), simIM.encode(im, 'BMP'):sub(1, 2), #simIM.encode(im, 'JPG') > 100)
print(simIM.dataURL(im):sub(1, 22), simIM.dataURL(im, 'JPG'):sub(1, 23))
e(simIM.encode, im, 'XYZ')
e(simIM.dataURL, im, 'gif')
e(simIM.read, 'nothing.png')
local _, id = sim.createTexture('', 1 + 4, {0.4, 0.2}, nil, nil, 1, {2, 2})
simIM.writeToTexture(im, id)
print(tostring(sim.readTexture(id, 0)) == tostring(sim.readTexture(id, 0)), #tostring(sim.readTexture(id, 0)))
e(simIM.writeToTexture, simIM.create(2, 2, simIM.format._32FC3), id)

-- markers
local dictionary = simIM.getMarkerDictionary(simIM.dict_type._ARUCO_ORIGINAL)
e(simIM.getMarkerDictionary, simIM.dict_type._5X5_50)
for _, name in ipairs {'_4X4_50', '_7X7_1000', '_ARUCO_ORIGINAL', '_APRILTAG_16h5', '_APRILTAG_36h11'} do io.write(simIM.getMarkerBitSize(simIM.dict_type[name]), ' ') end print()
e(simIM.getMarkerBitSize, 0)
local marker = simIM.drawMarker(dictionary, 42, 70)
print(simIM.size(marker), simIM.getFormat(marker))
local wall = simIM.compareK(simIM.create(120, 120, simIM.format._8UC1), {0}, simIM.cmpOp.eq)
simIM.copy(marker, {0, 0}, wall, {20, 30}, {70, 70})
local corners, ids, rejected = simIM.detectMarkers(wall, dictionary)
for i, corner in ipairs(corners) do corners[i] = math.floor(corner + 0.5) end
print(ids, corners, rejected)
simIM.flip(wall, simIM.flipOp.x, true)
print(select(2, simIM.detectMarkers(wall, dictionary)))
e(simIM.drawMarker, dictionary, 1024, 70)
e(simIM.drawMarker, dictionary, 1, 3)
e(simIM.drawMarker, 'x', 1, 30)
e(simIM.detectMarkers, marker, marker)
