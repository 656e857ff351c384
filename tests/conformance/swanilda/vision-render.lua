-- topic: sensors
-- as: sandbox
-- passes: 0
-- spec: sensors 3
-- Pictures of the scene: depth, directions and row order, colours, what is seen.
sim = require 'sim'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local function num(x) return string.format('%.6f', x) end
local function depth(...) return sim.unpackFloatTable((sim.getVisionSensorDepth(...))) end
local function pixel(s, x, y) return table.concat({tostring((sim.getVisionSensorImg(s, 0, 0, {x, y}, {1, 1}))):byte(1, -1)}, ' ') end
local EXPLICIT, PERSPECTIVE, OWN_BACKGROUND <const> = 1, 2, 128
local function sensor(options, width, height, near, far, extent, background)
    background = background or {0, 0, 0}
    return sim.createVisionSensor(options, {width, height, 0, 0}, {near, far, extent, 0.01, 0, 0, background[1], background[2], background[3], 0, 0})
end

-- A plane at 5 m, facing the sensor; then at 1 m.
local s = sensor(EXPLICIT + PERSPECTIVE, 16, 16, 0.01, 10, math.rad(60))
local plane = sim.createPrimitiveShape(sim.primitiveshape_plane, {100, 100, 0})
sim.setObjectPosition(plane, {0, 0, 5}) sim.setObjectOrientation(plane, {math.pi, 0, 0})
for _, z in ipairs {5, 1} do
    sim.setObjectPosition(plane, {0, 0, z})
    local result, packet, second = sim.handleVisionSensor(s)
    print(result, #packet, #second, num(packet[5]), num(packet[10]), num(packet[15]))
    print(num(depth(s)[1]), num(depth(s)[136]), num(depth(s, 1)[1]), num(depth(s, 1)[256]))
end
sim.removeObjects({plane})

-- +x of the sensor is on the left, +y in the last rows; the angle belongs to the larger side.
s = sensor(EXPLICIT + PERSPECTIVE, 64, 32, 0.01, 10, math.rad(60))
local function ball(x, y, z, size) local h = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {size, size, size}) sim.setObjectPosition(h, {x, y, z}) return h end
local function seen(s)
    local d, where = depth(s), {}
    local width = sim.getVisionSensorRes(s)[1]
    local x0, x1, y0, y1 = math.huge, -1, math.huge, -1
    for i, z in ipairs(d) do if z < 1 then local x, y = (i - 1) % width, (i - 1) // width x0 = math.min(x0, x) x1 = math.max(x1, x) y0 = math.min(y0, y) y1 = math.max(y1, y) end end
    return x0, x1, y0, y1
end
local b = ball(0.5, 0.25, 2, 0.1) sim.handleVisionSensor(s) print('left and up', seen(s))
sim.setObjectPosition(b, {-0.5, -0.25, 2}) sim.handleVisionSensor(s) print('right and down', seen(s))
local edge = 2 * math.tan(math.rad(30)) sim.setObjectPosition(b, {edge - 0.06, 0, 2}) sim.handleVisionSensor(s) print('left border', seen(s))
sim.setObjectPosition(b, {0, edge / 2 - 0.06, 2}) sim.handleVisionSensor(s) print('upper border', seen(s))
sim.setObjectPosition(b, {0, edge / 2 + 0.06, 2}) sim.handleVisionSensor(s) print('above it', seen(s))
local o = sensor(EXPLICIT, 20, 10, 0.1, 10, 2)
sim.setObjectPosition(b, {0.5, 0.25, 7}) sim.handleVisionSensor(o) print('orthographic', seen(o))

-- Silhouette of a ball of 1 m at 2 m: sin(a) = 0.25, a circle of radius tan(a).
sim.removeObjects({b}) b = ball(0, 0, 2, 1)
local q = sensor(EXPLICIT + PERSPECTIVE, 200, 200, 0.01, 10, math.rad(60)) sim.handleVisionSensor(q)
local n = 0 for _, z in ipairs(depth(q)) do if z < 1 then n = n + 1 end end
local radius = math.tan(math.asin(0.25)) / math.tan(math.rad(30)) * 100
print('silhouette', math.abs(n / (math.pi * radius * radius) - 1) < 0.02)

-- Backgrounds, modes, and what is seen.
local c = sensor(EXPLICIT + PERSPECTIVE + OWN_BACKGROUND, 8, 8, 0.01, 10, math.rad(60), {0, 0.5, 1})
sim.setShapeColor(b, nil, sim.colorcomponent_ambient_diffuse, {0, 0, 0}) sim.setShapeColor(b, nil, sim.colorcomponent_specular, {0, 0, 0})
sim.setShapeColor(b, nil, sim.colorcomponent_emission, {1, 0, 0.2}) sim.setShapeColor(b, nil, sim.colorcomponent_auxiliary, {0.4, 1, 0})
local function show(what) sim.handleVisionSensor(c) print(what, pixel(c, 4, 4), '|', pixel(c, 0, 0)) end
show('visible')
sim.setObjectInt32Param(c, sim.visionintparam_render_mode, 7) show('opengl3')
sim.setObjectInt32Param(c, sim.visionintparam_render_mode, 1) show('auxiliary')
sim.setObjectInt32Param(c, sim.visionintparam_render_mode, 2) show('handles')
local _, handles = sim.handleVisionSensor(c) print(#handles, handles[1] == b, string.format('%d 0 0', b & 255) == pixel(c, 4, 4))
sim.setBoolProperty(c, 'omitPacket1', true) print(#select(2, sim.handleVisionSensor(c))) sim.setBoolProperty(c, 'omitPacket1', false)
sim.setObjectInt32Param(c, sim.visionintparam_render_mode, 5) show('ray traced')
sim.setObjectInt32Param(c, sim.visionintparam_render_mode, 0)
sim.setObjectSpecialProperty(b, 0) show('not renderable')
sim.setObjectInt32Param(c, sim.visionintparam_entity_to_render, b) show('asked for by itself')
local set = sim.createCollection(0) sim.addItemToCollection(set, sim.handle_single, b, 0)
sim.setObjectInt32Param(c, sim.visionintparam_entity_to_render, set) show('in a collection')
local all = sim.createCollection(1) sim.addItemToCollection(all, sim.handle_single, b, 0)
sim.setObjectInt32Param(c, sim.visionintparam_entity_to_render, all) show('in one that overrides')
sim.setObjectInt32Param(c, sim.visionintparam_entity_to_render, 987654) show('an entity that does not exist')
sim.setObjectInt32Param(c, sim.visionintparam_entity_to_render, -1) sim.setObjectSpecialProperty(b, sim.objectspecialproperty_renderable)
sim.setObjectInt32Param(b, sim.objintparam_visibility_layer, 256) show('on a hidden layer')
sim.setObjectInt32Param(b, sim.objintparam_visibility_layer, 1) show('visible again')
sim.setObjectProperty(b, sim.objectproperty_depthinvisible) sim.handleVisionSensor(c) print('without depth', pixel(c, 4, 4), num(depth(c, 0, {4, 4}, {1, 1})[1]))
sim.setObjectProperty(b, 0)
sim.setBoolProperty(c, 'ignoreDepthInfo', true) sim.setShapeColor(b, nil, sim.colorcomponent_emission, {0, 1, 0}) show('depth ignored')
sim.setBoolProperty(c, 'ignoreImageInfo', true) sim.setShapeColor(b, nil, sim.colorcomponent_emission, {0, 0, 1}) show('image ignored')
sim.setBoolProperty(c, 'ignoreImageInfo', false) show('image again')

-- check leaves the sensor alone; an external image is not replaced.
print((sim.readVisionSensor(c)), select('#', sim.checkVisionSensor(c, b)), #sim.checkVisionSensorEx(c, b, true), #sim.checkVisionSensorEx(c, sim.handle_all, false))
local t = sensor(EXPLICIT + 16, 2, 1, 0.01, 10, 1) sim.setVisionSensorImg(t, '\1\2\3\4\5\6') print(sim.handleVisionSensor(t) == 0, pixel(t, 1, 0))
e(sim.checkVisionSensor, c, 4711) e(sim.checkVisionSensor, b, c) e(sim.checkVisionSensorEx, 4711, b, true)

-- Explicit handling.
local m = sim.createVisionSensor(PERSPECTIVE, {2, 2, 0, 0})
e(sim.handleVisionSensor, m) e(sim.handleVisionSensor, 4711) e(sim.handleVisionSensor, b)
print((sim.readVisionSensor(m))) print(sim.handleVisionSensor(sim.handle_all_except_explicit)) print((sim.readVisionSensor(m)), (sim.readVisionSensor(o)))
print(sim.handleVisionSensor(sim.handle_all)) print((sim.readVisionSensor(q)))

-- Handling can be switched off.
sim.resetVisionSensor(sim.handle_all) sim.setBoolParam(sim.boolparam_vision_sensor_handling_enabled, false)
print(sim.handleVisionSensor(q), (sim.readVisionSensor(q)))
sim.setBoolParam(sim.boolparam_vision_sensor_handling_enabled, true) print((sim.handleVisionSensor(q)), (sim.readVisionSensor(q)))

-- A picture can trigger.
local script = sim.createScript(sim.scripttype_customization, [[sim = require 'sim'
function sysCall_vision(d) return {trigger = true, packedPackets = {sim.packFloatTable{7}}} end]], 0, 'lua')
sim.setObjectParent(script, c, false) sim.initScript(script)
local result, _, found = sim.handleVisionSensor(c) print(result, found[1], (sim.readVisionSensor(c)), (sim.handleVisionSensor(sim.handle_all)))
print((sim.checkVisionSensor(c, b)))

-- From inside a wall, from nowhere, with sides of 1 and planes the wrong way round: nothing, or something, but no error.
local wall = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {2, 2, 2}) sim.handleVisionSensor(q) print(num(depth(q)[1]))
for _, size in ipairs {{1, 1}, {4096, 1}, {1, 300}} do local x = sensor(EXPLICIT + PERSPECTIVE, size[1], size[2], 0.01, 10, 1) e(sim.handleVisionSensor, x) sim.removeObjects({x}) end
for _, f in ipairs {{0, 10, 1}, {-1, 10, 1}, {10, 1, 1}, {1, 1, 1}, {0.01, 10, 0}, {0.01, 10, 4}, {0 / 0, 10, 1}, {0.01, math.huge, 1}, {0.01, 10, 0 / 0}} do
    local x = sensor(EXPLICIT + PERSPECTIVE, 4, 4, f[1], f[2], f[3]) e(sim.handleVisionSensor, x)
    local y = sensor(EXPLICIT, 4, 4, f[1], f[2], f[3]) e(sim.handleVisionSensor, y) sim.removeObjects({x, y})
end

-- Drawing objects: those that are tagged as paint. They cover what is behind them, and are no objects.
sim.removeObjects({wall})
local w = sensor(EXPLICIT + PERSPECTIVE + OWN_BACKGROUND, 9, 9, 0.01, 10, math.rad(60), {0, 0, 0})
local FACING <const> = 0x20000
local function drawn(kind, flags, item)
    local drawing = sim.addDrawingObject(kind + flags, 0.6, 0, -1, 10, {0, 0, 0}, nil, nil, {0, 1, 0})
    sim.addDrawingObjectItem(drawing, item)
    sim.handleVisionSensor(w)
    local colour, z = pixel(w, 4, 4), depth(w, 1, {4, 4}, {1, 1})[1]
    sim.removeDrawingObject(drawing)
    return colour, string.format('%.2f', z)
end
for _, kind in ipairs {'spherepts', 'cubepts', 'discpts', 'quadpts', 'trianglepts'} do
    print(kind, drawn(sim['drawing_' .. kind], sim.drawing_painttag + FACING, {0, 0, 1}))
end
print('triangles', drawn(sim.drawing_triangles, sim.drawing_painttag, {-1, -1, 1, 1, -1, 1, 0, 1, 1}))
print('not tagged', drawn(sim.drawing_spherepts, 0, {0, 0, 1}))
sim.setObjectInt32Param(w, sim.visionintparam_render_mode, 2) print('as handles', drawn(sim.drawing_spherepts, sim.drawing_painttag, {0, 0, 1}))
