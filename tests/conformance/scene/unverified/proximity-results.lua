-- as: sandbox
-- passes: 0
-- engine: bullet278
-- spec: sensors 1.2
-- tol: 1e-6
-- topic: sensors
sim = require 'sim'
local case = require 'lib.case'
local P, X = case.P, case.X
local function cube(size, ...)
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {size, size, size}, 0)
    sim.setObjectPosition(h, {...})
    return h
end
local function sensor(kind, options, floats) return sim.createProximitySensor(kind, 16, options, {32, 32, 1, 16, 1, 1, 0, 0}, floats) end
local s = sensor(sim.proximitysensor_ray, 1, {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.01, 0, 0})
local c = cube(0.2, 0.03, 0.02, 0.5)
local function R(label, r, d, p, h, n) P(label, r, d, p, h == c and 'cube' or h, n) end
R('check does not store', sim.checkProximitySensor(s, c))
R('read before', sim.readProximitySensor(s))
R('handle', sim.handleProximitySensor(s))
R('read', sim.readProximitySensor(s))
sim.resetProximitySensor(s)
R('read after reset', sim.readProximitySensor(s))
R('all', sim.handleProximitySensor(sim.handle_all))
R('none without explicit handling', sim.handleProximitySensor(sim.handle_all_except_explicit))
R('all detectable', sim.checkProximitySensor(s, sim.handle_all))
sim.setObjectSpecialProperty(c, 0)
R('not detectable', sim.checkProximitySensor(s, sim.handle_all))
R('named', sim.checkProximitySensor(s, c))
sim.setObjectSpecialProperty(c, sim.objectspecialproperty_detectable)
R('no sensor', sim.handleProximitySensor(c))
X('check no sensor', sim.checkProximitySensor, c, c)
X('check no entity', sim.checkProximitySensor, s, 12345)
X('reset not explicit', sim.resetProximitySensor, sensor(sim.proximitysensor_ray, 0, {0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.01, 0, 0}))
-- options: front or back faces, a threshold, an angle
R('front', sim.checkProximitySensor(s, c, 1))
R('back', sim.checkProximitySensor(s, c, 2))
R('threshold', sim.checkProximitySensor(s, c, -1, 0.3))
sim.setObjectOrientation(c, {math.rad(20), 0, 0})
P('10 degrees', (sim.checkProximitySensor(s, c, 3 + 8, 0, math.rad(10))))
P('30 degrees', (sim.checkProximitySensor(s, c, 3 + 8, 0, math.rad(30))))
sim.setObjectOrientation(c, {0, 0, 0})
-- a forbidden zone, and a cube in it
local z = sensor(sim.proximitysensor_cylinder, 1 + 256, {0, 1, 0, 0, 0, 0, 0, 0.25, 0.25, 0, 0, 0.2, 0.01, 0, 0})
P('free zone', (sim.handleProximitySensor(z)))
local near = cube(0.02, 0, 0, 0.1)
P('forbidden zone', (sim.handleProximitySensor(z)))
sim.removeObjects({near})
-- dummies are points in volumes; rays do not see them
local d = sim.createDummy(0.01)
sim.setObjectPosition(d, {0.1, 0, 0.2})
local _, distance, point, object, normal = sim.checkProximitySensor(z, d)
P('dummy', distance, point, object == d, normal)
sim.setObjectPosition(d, {0, 0, 0.3})
P('dummy on a ray', (sim.checkProximitySensor(s, d)))
-- properties, and an object that is removed after it was detected
sim.handleProximitySensor(s)
P('properties', sim.getIntProperty(s, 'detectedObjectHandle') == c, sim.getVector3Property(s, 'detectedPoint')[3], sim.getVector3Property(s, 'detectedNormal')[3])
sim.removeObjects({c})
P('object removed', sim.readProximitySensor(s))
