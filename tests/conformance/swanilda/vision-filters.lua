-- topic: simVision
-- as: sandbox
-- passes: 0
-- spec: simvision 1, simvision 2
-- Filters on work images: pixels as bytes, rows from the lowest one.
sim = require 'sim'
simVision = require 'simVision'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local function sensor(w, h) return sim.createVisionSensor(1 + 2 + 16, {w, h, 0, 0}, {0.1, 10, math.rad(60), 0.02, 0, 0, 0, 0, 0, 0, 0}) end
local s = sensor(4, 4)
local function black(n) return string.rep('\0', 3 * n) end
local function white(...)
    local pixels = {}
    for i = 1, 16 do pixels[i] = '\0\0\0' end
    for _, at in ipairs {...} do pixels[at[1] + 4 * at[2] + 1] = '\255\255\255' end
    return table.concat(pixels)
end
local function run(image, f, ...)
    sim.setVisionSensorImg(s, image)
    simVision.sensorImgToWorkImg(s)
    simVision[f](s, ...)
    simVision.workImgToSensorImg(s)
    return tostring((sim.getVisionSensorImg(s)))
end
-- the first byte of each pixel, a line for each row
local function show(image)
    for row = 0, 3 do
        local t = {}
        for column = 0, 3 do t[#t + 1] = image:byte(3 * (4 * row + column) + 1) end
        print(table.concat(t, ' '))
    end
end
local function bright(image)
    local t = {}
    for at = 0, 15 do if image:byte(3 * at + 1) == 255 then t[#t + 1] = (at % 4) .. ',' .. (at // 4) end end
    return table.concat(t, ' ')
end

-- every byte survives
local all = {}
for k = 0, 255 do all[k + 1] = string.char(k, 255 - k, k) end
local big = sensor(16, 16)
sim.setVisionSensorImg(big, table.concat(all))
print(simVision.sensorImgToWorkImg(big), simVision.workImgToSensorImg(big))
print(tostring((sim.getVisionSensorImg(big))) == table.concat(all))
-- now there is no work image
e(simVision.blobDetectionOnWorkImg, big, 0.5, 0, false)
e(simVision.sharpenWorkImg, s)

show(run(white({1, 1}), 'matrix3x3OnWorkImg', 1, 1))
show(run(string.rep('\128', 48), 'edgeDetectionOnWorkImg', 0.1))
print(bright(run(white({0, 0}), 'shiftWorkImg', {0.25, 0}, false)))
print(bright(run(white({3, 0}), 'shiftWorkImg', {0.25, 0}, false)))
print(bright(run(white({3, 0}), 'shiftWorkImg', {0.25, 0}, true)))
print(bright(run(white({0, 3}), 'rotateWorkImg', math.pi / 2)))
print(bright(run(white({1, 1}), 'resizeWorkImg', {2, 2})))
print(bright(run(string.rep('\255', 48), 'rectangularCutWorkImg', {0.5, 0.5}, false)))
print(bright(run(string.rep('\255', 48), 'circularCutWorkImg', 0.5, false)))
print(bright(run(white({0, 1}), 'horizontalFlipWorkImg')), bright(run(white({0, 1}), 'verticalFlipWorkImg')))

-- colours of one pixel
local function colour(value, f, ...)
    simVision.sensorImgToWorkImg(s)
    simVision.uniformImgToWorkImg(s, value)
    simVision[f](s, ...)
    simVision.workImgToSensorImg(s)
    return table.concat({tostring((sim.getVisionSensorImg(s, 0, 0, {0, 0}, {1, 1}))):byte(1, 3)}, ' ')
end
for _, level in ipairs {0, 0.5, 0.75, 1} do print(colour({level, level, level}, 'intensityScaleOnWorkImg', 0, 1, false)) end
print(colour({1, 0, 0}, 'selectiveColorOnWorkImg', {0, 0.5, 0.5}, {0.05, 0.5, 0.5}, false, true, false))
print(colour({0, 0, 1}, 'selectiveColorOnWorkImg', {0, 0.5, 0.5}, {0.05, 0.5, 0.5}, false, true, false))
print(colour({0.2, 0.4, 0.6}, 'scaleAndOffsetWorkImg', {0, 0.1, 0}, {2, 2, 2}, {0, 0, 0.5}, true))
print(colour({0.2, 0.4, 0.4}, 'normalizeWorkImg'))
print(colour({0.2, 0.4, 0.6}, 'colorSegmentationOnWorkImg', 0.1))

-- buffers
simVision.sensorImgToWorkImg(s)
simVision.uniformImgToWorkImg(s, {0.75, 0.5, 0.25})
simVision.workImgToBuffer1(s)
simVision.addBuffer1ToWorkImg(s)
simVision.subtractWorkImgFromBuffer1(s)
simVision.workImgToBuffer2(s)
simVision.swapWorkImgWithBuffer1(s)
simVision.swapBuffers(s)
simVision.multiplyWorkImgWithBuffer1(s)
simVision.addWorkImgToBuffer1(s)
simVision.subtractBuffer1FromWorkImg(s)
simVision.buffer1ToWorkImg(s)
simVision.workImgToSensorImg(s)
print(table.concat({tostring((sim.getVisionSensorImg(s))):byte(1, 3)}, ' '))
-- buffers keep the images
print(simVision.buffer2ToWorkImg(s))
sim.setVisionSensorImg(s, string.rep('\0\0\0\0\0\0\128\63', 8), 2)
simVision.sensorDepthMapToWorkImg(s)
simVision.workImgToSensorDepthMap(s)
print(table.concat(sim.unpackFloatTable((sim.getVisionSensorDepth(s)), 0, 2), ' '))

-- errors
e(simVision.sensorImgToWorkImg)
e(simVision.sensorImgToWorkImg, {})
e(simVision.sensorImgToWorkImg, 12345)
e(simVision.sensorImgToWorkImg, sim.createDummy(0.1))
e(simVision.shiftWorkImg, s, {1}, true)
e(simVision.shiftWorkImg, s, 'x', true)
e(simVision.shiftWorkImg, s, {1, 2})
e(simVision.matrix5x5OnWorkImg, s, 1, 1, {1, 2, 3})
e(simVision.shiftWorkImg, s, {0, 0, 0}, true, 'more')
sim.setObjectInt32Param(s, sim.visionintparam_resolution_x, 8)
e(simVision.sharpenWorkImg, s)
sim.removeObjects({s})
e(simVision.sharpenWorkImg, s)
e(simVision.workImgToSensorImg, s)
