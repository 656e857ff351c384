-- topic: proximity sensors
-- as: sandbox
-- passes: 0
-- spec: sensors 1.1, sensors 1.2
-- tol: 1e-6
-- note: checks with all options in numbers, and of points, segments and triangles of a script, by closed forms
sim = require 'sim'
sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
local text = require('lib.trial').text

local function sensor(kind, radius)
    -- Offset 0, range 4; sizes and radii at both ends.
    return sim.createProximitySensor(kind, 16, 0, {8, 8, 0, 0, 0, 0, 0, 0}, {0, 4, radius, radius, radius, radius, 0, radius, radius, 0, 0, 0, 0.01, 0, 0})
end
local function refused(f, ...) print('refused', (select(2, pcall(f, ...)):match('([^: ][^:]*%.)$'))) end

local FRONT, BACK, FAST, LIMITED = 1, 2, 4, 8
local ray = sensor(sim.proximitysensor_ray, 0)
local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
sim.setObjectPosition(box, {0, 0, 1.5})

local function check(what, mode, threshold, angle)
    local result, distance, point, object, normal = sim.checkProximitySensorEx(ray, box, mode, threshold, angle)
    print(what, result, text(distance), text(point), object == box and 'box' or object, text(normal))
end
check('front', FRONT, 0, 0)
check('back', BACK, 0, 0)
check('both', FRONT | BACK, 0, 0)
check('fast', FRONT | FAST, 0, 0)
check('near', FRONT, 0.9, 0)
check('far', FRONT, 1.1, 0)
check('as set', -1, 0, 0)
-- Turned by 30 degrees about x, the face is 0.5 / cos 30 nearer than the centre.
sim.setObjectOrientation(box, {math.pi / 6, 0, 0})
check('25 degrees', FRONT | LIMITED, 0, math.rad(25))
check('35 degrees', FRONT | LIMITED, 0, math.rad(35))
check('no limit', FRONT, 0, math.rad(25))
sim.setObjectInt32Param(box, sim.objintparam_visibility_layer, 0)
sim.setObjectSpecialProperty(box, 0)
check('undetectable', FRONT, 0, 0)
print('all', (sim.checkProximitySensorEx(ray, sim.handle_all, FRONT, 0, 0)))
refused(sim.checkProximitySensorEx, ray, 77777, FRONT, 0, 0)
refused(sim.checkProximitySensorEx, box, box, FRONT, 0, 0)

-- The frame is that of the sensor.
local tube = sensor(sim.proximitysensor_cylinder, 2)
sim.setObjectPose(tube, {5, 6, 7, 1, 0, 0, 0})
local function measure(what, vertices, kind, count, mode, threshold, angle)
    local result, distance, point = sim.checkProximitySensorEx2(tube, vertices, kind, count, mode, threshold, angle)
    print(what, result, text(distance), text(point))
end
measure('points', {0, 0, 1, 0.6, 0, 0.8, 0, 0.3, 0.4}, 0, 3, FRONT, 0, 0)
measure('two points', {0, 0, 1.5, 0.9, 0, 1.2, 0, 0.3, 0.4}, 0, 2, FRONT, 0, 0)
measure('too far', {0, 0, 1.5}, 0, 1, FRONT, 1.25, 0)
measure('outside', {0, 0, -1, 3, 0, 1, 0, 0, 5}, 0, 3, FRONT, 0, 0)
-- The nearest place of the first is (1, 0, 1), of the second its end.
measure('segments', {0.5, 0, 1.5, 1.5, 0, 0.5, 0, 1.5, 2, 0, 1.2, 1.6}, 1, 2, FRONT, 0, 0)
-- In the plane z = 2, wound towards the sensor and away from it.
local towards, away = {-1, -1, 2, -1, 1, 2, 1, -1, 2}, {-1, -1, 2, 1, -1, 2, -1, 1, 2}
measure('triangle', towards, 2, 1, FRONT, 0, 0)
measure('triangle', away, 2, 1, FRONT, 0, 0)
measure('triangle', away, 2, 1, BACK, 0, 0)
refused(sim.checkProximitySensorEx2, box, towards, 2, 1, FRONT, 0, 0)

-- Rays see triangles only.
print('ray', (sim.checkProximitySensorEx2(ray, {0, 0, 1}, 0, 1, FRONT, 0, 0)), (sim.checkProximitySensorEx2(ray, {0, 0, 1, 0, 0, 2}, 1, 1, FRONT, 0, 0)))
local result, distance, point, normal = sim.checkProximitySensorEx2(ray, towards, 2, 1, FRONT, 0, 0)
print('ray', result, text(distance), text(point), text(normal))
