-- topic: simVision
-- as: sandbox
-- passes: 0
-- spec: simvision 1, simvision 3
sim = require 'sim'
simVision = require 'simVision'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local function sensor(side) return sim.createVisionSensor(1 + 2 + 16, {side, side, 0, 0}, {0.1, 10, math.rad(60), 0.02, 0, 0, 0, 0, 0, 0, 0}) end
local s = sensor(8)
local function draw(...)
    local pixels = {}
    for i = 1, 64 do pixels[i] = '\0\0\0' end
    for _, at in ipairs {...} do pixels[at[1] + 8 * at[2] + 1] = '\255\255\255' end
    sim.setVisionSensorImg(s, table.concat(pixels))
    simVision.sensorImgToWorkImg(s)
end
local function numbers(packet, count)
    local t = packet and sim.unpackFloatTable(packet) or {}
    for i = 1, #t do t[i] = ('%.6g'):format(t[i]) end
    return table.concat(t, ' ', 1, count and math.min(count, #t) or #t)
end
local rectangle = {{2, 3}, {3, 3}, {4, 3}, {2, 4}, {3, 4}, {4, 4}}
local function binary(trigger, ...)
    return simVision.binaryWorkImg(s, 0.5, 0.1, 0.05, 0.4, 0.05, 0.4, 0.05, 0, 0.1, trigger and 0.4 or 0.3, true, ...)
end
draw(table.unpack(rectangle))
local trigger, packet = binary(true)
print(trigger, numbers(packet))
print((binary(false)))
for _, line in ipairs {{{0, 0}, {1, 1}, {2, 2}, {3, 3}}, {{0, 3}, {1, 2}, {2, 1}, {3, 0}}, {{2, 0}, {2, 1}, {2, 2}}, {}} do
    draw(table.unpack(line))
    print(numbers(select(2, binary(true))))
end

draw(table.unpack(rectangle))
trigger, packet = simVision.blobDetectionOnWorkImg(s, 0.5, 0, false)
print(trigger, numbers(packet))
trigger, packet = simVision.blobDetectionOnWorkImg(s, 0.5, 0.1, false)
print(trigger, numbers(packet))
simVision.workImgToSensorImg(s)
print(tostring((sim.getVisionSensorImg(s))) == string.rep('\0', 192))
draw({0, 0}, {7, 7})
print(numbers(select(2, simVision.blobDetectionOnWorkImg(s, 0.5, 0, true, {1, 0, 1}))))
simVision.workImgToSensorImg(s)
print(tostring((sim.getVisionSensorImg(s))):byte(1, 3))

-- pixels that change
simVision.sensorImgToWorkImg(s)
simVision.uniformImgToWorkImg(s, {0.5, 0.5, 0.5})
simVision.workImgToBuffer2(s)
simVision.workImgToSensorImg(s, false)
local image = tostring((sim.getVisionSensorImg(s)))
local at = 3 * (3 + 8 * 2)
sim.setVisionSensorImg(s, image:sub(1, at) .. '\255\255\255' .. image:sub(at + 4))
simVision.sensorImgToWorkImg(s)
local found, changes = simVision.changedPixelsOnWorkImg(s, 0.1)
print(found, numbers(changes))
simVision.workImgToSensorImg(s, false)
print(tostring((sim.getVisionSensorImg(s))):byte(at, at + 1))
print(select('#', simVision.changedPixelsOnWorkImg(s, 0.1)))
sim.setVisionSensorImg(s, image)
simVision.sensorImgToWorkImg(s)
simVision.workImgToBuffer2(s)
print(select('#', simVision.changedPixelsOnWorkImg(s, 0.1)))

-- points from depths
local camera = sensor(64)
local function plane(depth)
    simVision.sensorImgToWorkImg(camera)
    simVision.uniformImgToWorkImg(camera, {depth, depth, depth})
end
plane(0.5)
print(numbers(select(2, simVision.coordinatesFromWorkImg(camera, {3, 3}, true)), 6))
local middle = sim.unpackFloatTable((select(2, simVision.coordinatesFromWorkImg(camera, {3, 3}, true))))
print(('%.6g %.6g %.6g %.6g'):format(table.unpack(middle, 19, 22)))
plane(1)
local far = sim.unpackFloatTable((select(2, simVision.coordinatesFromWorkImg(camera, {3, 3}, true))))
print(('%.6g %.6g %.6g %.6g'):format(table.unpack(far, 15, 18)))
sim.setObjectPosition(camera, {1, 2, 3})
local moved = sim.unpackFloatTable((select(2, simVision.coordinatesFromWorkImg(camera + sim.handleflag_abscoords, {1, 1}, false))))
print(('%.6g %.6g %.6g %.6g'):format(table.unpack(moved, 3, 6)))
print(select('#', simVision.coordinatesFromWorkImg(camera, {2, 2}, true, true)))
simVision.workImgToBuffer1(camera)
print(#select(3, simVision.coordinatesFromWorkImg(camera, {2, 2}, true, true)))
print(numbers(select(2, simVision.velodyneDataFromWorkImg(camera, {1, 2}, math.pi / 2)), 6))
e(simVision.coordinatesFromWorkImg, camera, {0, 1}, true)
e(simVision.coordinatesFromWorkImg, camera, {1 << 40, 1 << 40}, true)
e(simVision.coordinatesFromWorkImg, camera, {1}, true)
e(simVision.coordinatesFromWorkImg, camera)

-- a map of pixels
e(simVision.distort, s)
e(simVision.distort, s, {1, 2})
local map = {}
for i = 1, 64 do map[i] = 64 - i end
sim.setVisionSensorImg(s, '\1\2\3' .. string.rep('\0', 189))
print(simVision.distort(s, map))
print(tostring((sim.getVisionSensorImg(s))):byte(-3, -1))
print(simVision.distort(s), tostring((sim.getVisionSensorImg(s))):byte(1, 3))
map[1] = 64
e(simVision.distort, s, map)
e(simVision.distort, 77777)
