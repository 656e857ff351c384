-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: sensors 1.2
-- tol: 1e-6
-- topic: sensors
sim = require 'sim'
local case = require 'lib.case'
local P = case.P
local function cube(size, ...)
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {size, size, size}, 0)
    sim.setObjectPosition(h, {...})
    return h
end
local s = sim.createProximitySensor(sim.proximitysensor_ray, 16, 1, {32, 32, 1, 16, 1, 1, 0, 0}, {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.01, 0, 0})
local c = cube(0.2, 0, 0.02, 0.5)
local function script(code)
    local h = sim.createScript(sim.scripttype_customization, 'sim = require "sim" ' .. code)
    sim.setObjectParent(h, s)
    sim.initScript(h)
    return h
end
-- no answer, then an answer: the third script is not asked
script('function sysCall_trigger(inData) sim.setInt32Signal("first", inData.object) end')
local veto = script('function sysCall_trigger(inData) sim.setStringSignal("keys", sim.packTable(inData)) return {trigger = false} end')
script('function sysCall_trigger(inData) sim.setInt32Signal("third", 1) end')
P('vetoed', sim.handleProximitySensor(s))
P('read', sim.readProximitySensor(s))
P('asked', sim.getInt32Signal('first') == c, sim.getInt32Signal('third'))
local data, names = sim.unpackTable(sim.getStringSignal('keys')), {}
for name in pairs(data) do names[#names + 1] = name end
table.sort(names)
P('names', table.concat(names, ' '))
P('data', data.handle == s, data.proximitySensor == s, data.detectedObjectHandle == c, data.point, data.detectedPoint, data.normal, data.normalVector)
P('check asks nobody', (sim.checkProximitySensor(s, c)))
sim.removeObjects({veto})
P('without veto', (sim.handleProximitySensor(s)))
P('asked', sim.getInt32Signal('third'))
-- a script that removes the sensor, or what it detects
script('function sysCall_trigger(inData) sim.removeObjects({inData.object}) end')
P('removed', (sim.handleProximitySensor(s)))
P('read', sim.readProximitySensor(s))
cube(0.2, 0, 0.02, 0.5)
script('function sysCall_trigger(inData) sim.removeObjects({inData.handle}) end')
P('sensor removed', (sim.handleProximitySensor(s)))
P('sensor', sim.isHandle(s))
