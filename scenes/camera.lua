-- A camera on a carousel takes pictures of some objects: colours, depths, and which object is where.
--
--     swanilda run scenes/camera.lua -D folder=/tmp

sim = require 'sim'

local PICTURES, RADIUS, HEIGHT = 4, 1.6, 0.9

local function coloured(shape, position, colour)
    sim.setObjectPosition(shape, position)
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, colour)
    return shape
end

local function cross(a, b) return {a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1]} end

local function unit(v)
    local length = math.sqrt(v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2)
    return {v[1] / length, v[2] / length, v[3] / length}
end

-- A sensor looks along its z axis, and y is up.
local function lookAt(sensor, from, to)
    local z = unit {to[1] - from[1], to[2] - from[2], to[3] - from[3]}
    local x = unit(cross({0, 0, 1}, z))
    local y = cross(z, x)
    sim.setObjectMatrix(sensor, {x[1], y[1], z[1], from[1], x[2], y[2], z[2], from[2], x[3], y[3], z[3], from[3]})
end

local function scenery()
    coloured(sim.createPrimitiveShape(sim.primitiveshape_plane, {3, 3, 0}), {0, 0, 0}, {0.8, 0.8, 0.75})
    local table_ = coloured(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.8, 0.8, 0.1}), {0, 0, 0.3}, {0.55, 0.35, 0.2})
    sim.setObjectAlias(table_, 'Table')
    for _, corner in ipairs {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}} do
        coloured(sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.05, 0.05, 0.25}), {0.35 * corner[1], 0.35 * corner[2], 0.125}, {0.3, 0.3, 0.3})
    end
    sim.setObjectAlias(coloured(sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2}), {0.15, 0.1, 0.45}, {0.8, 0.1, 0.1}), 'Ball')
    sim.setObjectAlias(coloured(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.2}), {-0.2, 0.1, 0.45}, {0.1, 0.3, 0.8}), 'Box')
    sim.setObjectAlias(coloured(sim.createPrimitiveShape(sim.primitiveshape_cone, {0.2, 0.2, 0.25}), {0, -0.2, 0.475}, {0.1, 0.6, 0.2}), 'Cone')
end

function sysCall_init()
    scenery()
    -- Handled explicitly, in perspective, with a background of its own.
    camera = sim.createVisionSensor(1 + 2 + 128, {320, 240, 0, 0}, {0.1, 6, math.rad(50), 0.05, 0, 0, 0.7, 0.8, 0.95, 0, 0})
    sim.setObjectAlias(camera, 'Camera')
    lookAt(camera, {RADIUS, 0, HEIGHT}, {0, 0, 0.3})
    folder = sim.getNamedStringParam('folder')
    taken = 0
end

-- Images of sensors begin with the lowest row, files with the highest.
local function write(name, image, resolution)
    local upright = sim.transformImage(image, resolution, 4)
    if folder then sim.saveImage(upright, resolution, 0, string.format('%s/%s.png', folder, name), -1) end
end

-- Nearest depth along the axis, metres.
local function nearest()
    local _, packet = sim.readVisionSensor(camera)
    local planes = sim.getFloatArrayProperty(camera, 'clippingPlanes')
    return planes[1] + packet[5] * (planes[2] - planes[1])
end

-- The colour of an object is its handle in this mode, and the first packet lists those that are seen.
local function seen()
    sim.setObjectInt32Param(camera, sim.visionintparam_render_mode, 2)
    local _, handles = sim.handleVisionSensor(camera)
    sim.setObjectInt32Param(camera, sim.visionintparam_render_mode, 0)
    return #handles
end

function sysCall_sensing()
    if taken == PICTURES then return end
    local angle = 2 * math.pi * taken / PICTURES
    lookAt(camera, {RADIUS * math.cos(angle), RADIUS * math.sin(angle), HEIGHT}, {0, 0, 0.3})
    sim.handleVisionSensor(camera)
    taken = taken + 1
    local image, resolution = sim.getVisionSensorImg(camera)
    write('camera_' .. taken, image, resolution)
    print(string.format('picture %d: nearest point at %.2f m, %d objects seen', taken, nearest(), seen()))
    if taken == PICTURES then sim.stopSimulation() end
end
