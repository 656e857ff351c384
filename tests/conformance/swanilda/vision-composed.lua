-- topic: simVision
-- as: sandbox
-- passes: 0
-- spec: simvision 1, simvision 4
-- Sensors that are composed of others. The sensors see walls of colours around the origin.
sim = require 'sim'
simVision = require 'simVision'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local function sensor(w, h, options, external) return sim.createVisionSensor(1 + 2 + (external and 16 or 0), {w, h, 0, 0}, {0.1, 10, math.pi / 2, 0.02, 0, 0, 0, 0, 0, 0, 0}) end

-- two pictures that scripts made: external input stays when it is handled
local left, right, both = sensor(2, 1, 0, true), sensor(2, 1, 0, true), sensor(2, 1, 0, true)
sim.setVisionSensorImg(left, '\255\255\255\0\0\0')
sim.setVisionSensorImg(right, '\0\0\0\128\128\128')
print(simVision.handleAnaglyphStereo(both, {left, right}))
print(tostring((sim.getVisionSensorImg(both))):byte(1, 6))
print(simVision.handleAnaglyphStereo(both, {left, right}, {0, 0, 1, 1, 0, 0}))
print(tostring((sim.getVisionSensorImg(both))):byte(1, 6))
e(simVision.handleAnaglyphStereo, both, {left})
e(simVision.handleAnaglyphStereo, both, {left, 12345})
e(simVision.handleAnaglyphStereo, both, {left, sensor(3, 1, 0, true)})
local implicit = sim.createVisionSensor(2 + 16, {2, 1, 0, 0})
e(simVision.handleAnaglyphStereo, both, {left, implicit})

-- six faces of one colour each: front, top, back, bottom, left, right
local faces, passive = {}, sensor(8, 4, 0, true)
for i = 1, 6 do
    faces[i] = sensor(4, 4, 0, true)
    sim.setVisionSensorImg(faces[i], string.rep(string.char(i * 40), 48))
end
local depth = sensor(8, 4, 0, true)
print(simVision.handleSpherical(passive, faces, 2 * math.pi, math.pi / 3, depth))
local image = tostring((sim.getVisionSensorImg(passive)))
for row = 0, 3 do
    local t = {}
    for column = 0, 7 do t[#t + 1] = image:byte(3 * (8 * row + column) + 1) // 40 end
    print(table.concat(t, ' '))
end
e(simVision.handleSpherical, -1, faces, 1, 1)
e(simVision.handleSpherical, passive, faces, 1, 1, both)
e(simVision.handleSpherical, passive, {faces[1]}, 1, 1)
e(simVision.handleSpherical, passive, {both, both, both, both, both, both}, 1, 1)
e(simVision.handleSpherical, passive, {implicit, implicit, implicit, implicit, implicit, implicit}, 1, 1)

-- a scanner: the scripts of its sensors return points
local sensors = {}
for i = 1, 4 do
    sensors[i] = sensor(16, 16, 0)
    sim.setObjectOrientation(sensors[i], {math.pi / 2, 0, 0})
    local turn = sim.rotateAroundAxis(sim.getObjectMatrix(sensors[1]), {0, 0, 1}, {0, 0, 0}, (i - 1) * math.pi / 2)
    sim.setObjectMatrix(sensors[i], turn)
    local script = sim.createScript(sim.scripttype_customization, [[
        sim = require 'sim'
        simVision = require 'simVision'
        function sysCall_vision(data)
            simVision.sensorImgToWorkImg(data.handle)
            simVision.workImgToBuffer1(data.handle)
            simVision.uniformImgToWorkImg(data.handle, {0.1, 0.1, 0.1})
            local _, points, colours = simVision.velodyneDataFromWorkImg(data.handle, {4, 1}, 0.1, true)
            return {packedPackets = {points, colours}}
        end
    ]])
    sim.setObjectParent(script, sensors[i])
    sim.initScript(script)
end
local scanner = simVision.createVelodyneVPL16(sensors, 10)
print(scanner, simVision.createVelodyneVPL16(sensors, 5, 4), simVision.createVelodyneHDL64E(sensors, 20))
local points, colours = simVision.handleVelodyneVPL16(scanner, 0.1)
print(#points, #colours)
local function angles(list)
    local t = {}
    for i = 1, #list, 3 do t[#t + 1] = ('%.0f'):format(math.deg(math.atan(list[i], list[i + 2]))) end
    table.sort(t, function(a, b) return tonumber(a) < tonumber(b) end)
    return table.concat(t, ' ')
end
print(angles(points))
local quarter = simVision.handleVelodyneVPL16(scanner, 0.025)
print(angles(quarter))
print(#sim.unpackFloatTable((simVision.handleVelodyneVPL16(scanner + sim.handleflag_codedstring, 0.025))) // 3)
local polar = simVision.handleVelodyneVPL16(1, 0.2)
print(#polar, ('%.4f'):format(polar[2]))
print(simVision.destroyVelodyneVPL16(scanner))
e(simVision.handleVelodyneVPL16, scanner, 0.1)
e(simVision.destroyVelodyneHDL64E, 7)
e(simVision.createVelodyneVPL16, sensors)
e(simVision.createVelodyneVPL16, {sensors[1]}, 5)
e(simVision.createVelodyneVPL16, {sensors[1], left, 12345, left}, 5)
e(simVision.createVelodyneVPL16, sensors, 5, 0, 2, {1, 5}, 1, 12345)
e(simVision.createVelodyneVPL16, sensors, 5, 0, 2, {1, 5}, 1, left)
-- a point cloud takes the points, in its own frame, also of a scanner with polar results
local cloud = sim.createPointCloud(0.02, 20, 0, 4)
sim.setObjectPosition(cloud, {10, 0, 0})
local keeping = simVision.createVelodyneVPL16(sensors, 10, 0, 2, {1, 5}, 1, cloud)
local first = simVision.handleVelodyneVPL16(keeping + sim.handleflag_abscoords, 0.025)
local kept = sim.getPointCloudPoints(cloud)
local largest = 0
for i, value in ipairs(kept) do largest = math.max(largest, math.abs(value + (i % 3 == 1 and 10 or 0) - first[i])) end
print(#first, #kept, largest < 1e-12)
simVision.handleVelodyneVPL16(keeping, 0.025)
print(#sim.getPointCloudPoints(cloud))
local current = simVision.createVelodyneVPL16(sensors, 10, 2 + 4, 2, {1, 5}, 1, cloud)
simVision.handleVelodyneVPL16(current, 0.025)
print(#sim.getPointCloudPoints(cloud))
sim.removeObjects({cloud})
e(simVision.handleVelodyneVPL16, current, 0.025)
-- sensors without packets
local silent = simVision.createVelodyneHDL64E({right, right, left, left}, 20)
print(select('#', simVision.handleVelodyneHDL64E(silent, 0.1)))
sim.removeObjects({right})
e(simVision.handleVelodyneHDL64E, silent, 0.1)
