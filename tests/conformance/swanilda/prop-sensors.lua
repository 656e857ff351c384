-- topic: properties
-- as: sandbox
-- passes: 0
-- spec: properties 6, sensors 1.1, sensors 3
sim = require 'sim'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and m or (m:gsub('^%-?%d+: ', ''))) end
local p = sim.createProximitySensor(sim.proximitysensor_pyramid, 16, 1 + 8)
print(sim.getProperty(p, 'sensorType'), sim.getProperty(p, 'explicitHandling'), sim.getProperty(p, 'frontFaceDetection'), sim.getProperty(p, 'backFaceDetection'), sim.getProperty(p, 'exactMode'))
print(sim.getProperty(p, 'volume_offset'), sim.getProperty(p, 'volume_range'), sim.getProperty(p, 'volume_xSize'), sim.getProperty(p, 'volume_ySize'))
print(#sim.getProperty(p, 'volume_edges') // 6, #sim.getProperty(p, 'volume_closeEdges'), sim.getProperty(p, 'detectedObjectHandle'))
sim.setBoolProperty(p, 'explicitHandling', false) print(sim.getExplicitHandling(p))
sim.setExplicitHandling(p, 1) print(sim.getProperty(p, 'explicitHandling'))
sim.setFloatArrayProperty(p, 'volume_xSize', {0.3, 0.6}) print(sim.getProperty(p, 'volume_xSize'))
sim.setFloatProperty(p, 'volume_range', -1) print(sim.getProperty(p, 'volume_range') > 0)
e(sim.setFloatArrayProperty, p, 'volume_ySize', {0.3})
e(sim.setFloatProperty, p, 'volume_range', 0 / 0)
e(sim.setFloatProperty, p, 'sensorPointSize', math.huge)
e(sim.setIntProperty, p, 'sensorType', 31)
local v = sim.createVisionSensor(2, {64, 32, 0, 0}, {0.1, 5, 1, 0.02, 0, 0, 0.5, 0.25, 0, 0, 0})
print(sim.getIntArray2Property(v, 'resolution'), sim.getProperty(v, 'perspective'), sim.getProperty(v, 'clippingPlanes'), sim.getProperty(v, 'viewAngle'), sim.getProperty(v, 'backgroundColor'))
sim.setObjectFloatParam(v, sim.visionfloatparam_far_clipping, 7) print(sim.getProperty(v, 'clippingPlanes'))
sim.setFloatProperty(v, 'viewAngle', 0.5) print(sim.getObjectFloatParam(v, sim.visionfloatparam_perspective_angle))
sim.setIntArray2Property(v, 'resolution', {-3, 100000}) print(sim.getObjectInt32Param(v, sim.visionintparam_resolution_x), sim.getObjectInt32Param(v, sim.visionintparam_resolution_y))
sim.setIntArray2Property(v, 'resolution', {2, 1})
local near = sim.getVector3Property(v, 'frustumCornerNear')
print(string.format('%.6f %.6f %.1f', near[1], near[2], near[3]), string.format('%.6f', 0.1 * math.tan(0.25)))
sim.setBufferProperty(v, 'imageBuffer', '\1\2\3\4\5\6') print(#sim.getProperty(v, 'imageBuffer'))
e(sim.setBufferProperty, v, 'imageBuffer', '\1\2')
sim.scaleObjects({p, v}, 2, false)
print(sim.getProperty(p, 'volume_xSize'), sim.getProperty(v, 'sensorSize'), sim.getProperty(v, 'clippingPlanes'))
local f = sim.createForceSensor(1, {0, 5, 3, 0, 0}, {0.05, 80, 8, 0, 0})
print(sim.getProperty(f, 'forceThresholdEnabled'), sim.getProperty(f, 'torqueThresholdEnabled'), sim.getProperty(f, 'filterSampleSize'), sim.getProperty(f, 'consecutiveViolationsToTrigger'), sim.getProperty(f, 'forceThreshold'))
sim.setIntProperty(f, 'filterType', 1) e(sim.setIntProperty, f, 'filterType', 2) print(sim.getProperty(f, 'filterType'), sim.getProperty(f, 'sensorForce'))
