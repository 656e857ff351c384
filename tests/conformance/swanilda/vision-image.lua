-- topic: sensors
-- as: sandbox
-- passes: 0
-- spec: sensors 3
-- Pictures that scripts set and read, and what scripts of the sensor make of them.
sim = require 'sim'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local function bytes(buffer) return table.concat({tostring(buffer):byte(1, -1)}, ' ') end
local function depth(...) return sim.unpackFloatTable((sim.getVisionSensorDepth(...))) end
local s = sim.createVisionSensor(1 + 2 + 16, {3, 2, 0, 0}, {0.1, 1.1, 1, 0.02, 0, 0, 0, 0, 0, 0, 0})

-- Before there is a picture.
print(sim.readVisionSensor(s))
local image, resolution = sim.getVisionSensorImg(s)
print(#image, bytes(image), resolution)
print(depth(s), sim.getVisionSensorRes(s))

-- Parts, from the lowest row.
local function ramp(n) local t = {} for i = 1, n do t[i] = i * 10 end return string.char(table.unpack(t)) end
sim.setVisionSensorImg(s, ramp(18))
print(bytes(sim.getVisionSensorImg(s, 0, 0, {1, 0}, {2, 2})))
print(bytes(sim.getVisionSensorImg(s, 1, 0, {1, 0}, {2, 2})))
local _, full = sim.getVisionSensorImg(s, 1, 0, {2, 1}, {1, 1})
print(full)
sim.setVisionSensorImg(s, '\1\2', 1, {0, 1}, {2, 1})
print(bytes(sim.getVisionSensorImg(s)))
sim.setVisionSensorImg(s, sim.packFloatTable({0, 0.25, 0.5, 0.75, 1, 1}), 2)
print(bytes(sim.getVisionSensorImg(s, 3, 0.5)))
print(bytes(sim.getVisionSensorImg(s, 2, 0.5, {2, 0}, {1, 2})))
for _, z in ipairs(depth(s, 1)) do io.write(string.format('%.4f ', z)) end print()
print(depth(s, 0, {1, 0}, {1, 2}))

-- The first packet: smallest, largest and mean; colours in whole steps of a byte.
local result, packet, more = sim.readVisionSensor(s)
print(result, #packet, more)
for i = 1, 15 do io.write(string.format(i % 5 == 0 and '%.4f ' or '%d ', i % 5 == 0 and packet[i] or math.floor(packet[i] * 255 + 0.5))) end print()
sim.setBoolProperty(s, 'omitPacket1', true)
sim.setVisionSensorImg(s, ramp(18))
print(sim.readVisionSensor(s))
sim.setBoolProperty(s, 'omitPacket1', false)
sim.resetVisionSensor(s) print(sim.readVisionSensor(s))

-- What does not fit.
e(sim.setVisionSensorImg, s, 'abc')
e(sim.setVisionSensorImg, s, 'abc', 1)
e(sim.setVisionSensorImg, s, ('x'):rep(25), 2)
e(sim.getVisionSensorImg, s, 0, 0, {2, 0}, {2, 1})
e(sim.getVisionSensorImg, s, 0, 0, {-1, 0}, {1, 1})
e(sim.getVisionSensorImg, s, 0, 0, {0, 0}, {1, 0})
e(sim.getVisionSensorImg, s, 0, 0, {0 / 0, 1e300}, {1, 1e300})
e(sim.getVisionSensorDepth, s, 0, {0, 2}, {1, 1})
local dummy = sim.createDummy(0.01)
e(sim.getVisionSensorImg, dummy) e(sim.setVisionSensorImg, dummy, '') e(sim.readVisionSensor, dummy) e(sim.resetVisionSensor, dummy)
e(sim.getVisionSensorImg, 4711) e(sim.readVisionSensor, -7) e(sim.resetVisionSensor, 4711)
local other = sim.createVisionSensor(0, {1, 1, 0, 0})
e(sim.resetVisionSensor, other) e(sim.resetVisionSensor, sim.handle_all) e(sim.resetVisionSensor, sim.handle_all_except_explicit)

-- Scripts look at each picture that is set: all of them, unless they are doing so already.
local code = [[sim = require 'sim'
function sysCall_init() self = sim.getObject('..') end
function sysCall_vision(data)
    local keys = {} for key in pairs(data) do keys[#keys + 1] = key end table.sort(keys)
    print('NAME', table.concat(keys, ' '))
    print(data.handle == self, data.visionSensor == self, data.resolution, data.clippingPlanes, data.viewAngle, data.orthoSize, data.perspectiveOperation)
    sim.setVisionSensorImg(self, ('\3'):rep(18))
    return {trigger = true, packedPackets = {sim.packFloatTable{1, 2}, 5, '', 'abcdefg'}}
end
function sysCall_trigger(data) print('trigger', data.handle == self, data.visionSensor == self, #data.packedPackets, #data.packedPackets[1], sim.unpackFloatTable(data.packedPackets[2])) end]]
local names = {'first', 'second'}
for _, name in ipairs(names) do
    local script = sim.createScript(sim.scripttype_customization, code:gsub('NAME', name), 0, 'lua')
    sim.setObjectParent(script, s, false)
    sim.initScript(script)
end
sim.setVisionSensorImg(s, ramp(18))
local n = select('#', sim.readVisionSensor(s))
print(n, (sim.readVisionSensor(s)), select(3, sim.readVisionSensor(s)))
print(bytes(sim.getVisionSensorImg(s, 1)))
sim.setVisionSensorImg(s, ramp(18), 4) -- nobody is called
print(bytes(sim.getVisionSensorImg(s, 1)), (select('#', sim.readVisionSensor(s))))

-- A script that removes its sensor.
local script = sim.createScript(sim.scripttype_customization, "sim = require 'sim' function sysCall_vision(d) sim.removeObjects({d.handle}) return {trigger = true} end", 0, 'lua')
sim.setObjectParent(script, other, false) sim.initScript(script)
e(sim.setVisionSensorImg, other, 'abc') print(sim.isHandle(other)) e(sim.readVisionSensor, other)

-- As before 4.6.
local o = sim.createVisionSensor(1 + 2 + 16, {2, 1, 0, 0}, {0.1, 1.1, 1, 0.02, 0, 0, 0, 0, 0, 0, 0})
print(sim.setVisionSensorImage(o, {0, 0.2, 0.4, 0.6, 0.8, 1}))
print(bytes(sim.getVisionSensorCharImage(o)), select(2, sim.getVisionSensorCharImage(o)))
for _, v in ipairs(sim.getVisionSensorImage(o)) do io.write(string.format('%.4f ', v)) end print()
print(#sim.getVisionSensorImage(o, 1, 0, 1, 1), sim.getVisionSensorImage(o + sim.handleflag_greyscale)[2] * 255, bytes(sim.getVisionSensorImage(o, 0, 0, 0, 0, 1)))
print(bytes(sim.getVisionSensorCharImage(o + sim.handleflag_greyscale)), bytes(sim.getVisionSensorCharImage(o, 1, 0, 1, 1, 0.5)))
print(sim.setVisionSensorImage(o + 0x800000, {0.5, 0.25}), sim.getVisionSensorDepthBuffer(o), #sim.getVisionSensorDepthBuffer(o + sim.handleflag_codedstring))
print(string.format('%.4f', sim.getVisionSensorDepthBuffer(o + sim.handleflag_depthbuffermeters)[1]), sim.setVisionSensorCharImage(o + sim.handleflag_greyscale, '\7\8'), bytes(sim.getVisionSensorImg(o)))
e(sim.setVisionSensorImage, o, {1, 2}) e(sim.setVisionSensorImage, o, 'ab') e(sim.setVisionSensorImage, o, {a = 1}) e(sim.setVisionSensorImage, o, true)
e(sim.setVisionSensorImage, o, {1, 2, 3, 4, 5, {}}) e(sim.setVisionSensorCharImage, dummy, '') e(sim.setVisionSensorCharImage, 4711, '')
e(sim.getVisionSensorImage, dummy) e(sim.getVisionSensorCharImage, 4711) e(sim.getVisionSensorDepthBuffer, o, 1, 0, 2, 1)
