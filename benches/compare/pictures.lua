-- What pictures.py compares with other programs, in Swanilda: a floor, 49 boxes and the bumpy ball, seen by sensors that a script handles.
-- Globals from Python: RINGS, CASES (name, width, height, cameras, with masks). Prints the name and milliseconds.
sim = require 'sim'

local function ball()
    local sectors, vertices, triangles = 2 * RINGS, {}, {}
    for r = 0, RINGS do
        local polar = math.pi * r / RINGS
        for s = 0, sectors - 1 do
            local around = 2 * math.pi * s / sectors
            local radius = 0.5 + 0.05 * math.sin(5 * polar) * math.sin(6 * around)
            local flat = radius * math.sin(polar)
            for _, x in ipairs {flat * math.cos(around), flat * math.sin(around), radius * math.cos(polar) + 0.6} do
                vertices[#vertices + 1] = x
            end
        end
    end
    local function at(r, s) return r * sectors + s % sectors end
    for r = 0, RINGS - 1 do
        for s = 0, sectors - 1 do
            for _, corner in ipairs {at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s), at(r + 1, s + 1), at(r, s + 1)} do
                triangles[#triangles + 1] = corner
            end
        end
    end
    return sim.createShape(0, math.pi, vertices, triangles)
end

local function box(size, place, colour)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectPosition(shape, place)
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, colour)
end

local function scene()
    box({6, 6, 0.1}, {0, 0, -0.05}, {0.6, 0.6, 0.6})
    for i = 0, 48 do box({0.15, 0.15, 0.3}, {i % 7 * 0.4 - 1.2, i // 7 * 0.4 - 1.2, 0.15}, {0.2, 0.3, 0.8}) end
    sim.setShapeColor(ball(), nil, sim.colorcomponent_ambient_diffuse, {0.8, 0.2, 0.1})
end

--- A sensor on a circle around the scene, after so many turns from the place of the others' camera.
local function sensor(width, height, turns, masks)
    local handle = sim.createVisionSensor(3, {width, height, 0, 0}, {0.01, 10, math.rad(60), 0.01, 0, 0, 0, 0, 0, 0, 0})
    local c, s = math.cos(2 * math.pi * turns), math.sin(2 * math.pi * turns)
    local eye = {1.6 * (c + s), 1.6 * (s - c), 1.2}
    local length = math.sqrt(eye[1] ^ 2 + eye[2] ^ 2 + 1.05 ^ 2)
    local z = {-eye[1] / length, -eye[2] / length, -1.05 / length}
    local flat = math.sqrt(z[1] ^ 2 + z[2] ^ 2)
    local x = {-z[2] / flat, z[1] / flat, 0}
    local y = {z[2] * x[3] - z[3] * x[2], z[3] * x[1] - z[1] * x[3], z[1] * x[2] - z[2] * x[1]}
    sim.setObjectMatrix(handle, {x[1], y[1], z[1], eye[1], x[2], y[2], z[2], eye[2], x[3], y[3], z[3], eye[3]})
    if masks then sim.setObjectInt32Param(handle, sim.visionintparam_render_mode, 2) end
    return handle
end

--- Milliseconds for all sensors: the best mean of several series.
local function measure(sensors)
    local best = math.huge
    for _ = 1, 6 do
        local began, count = sim.getSystemTime(), 0
        repeat
            for _, handle in ipairs(sensors) do sim.handleVisionSensor(handle) end
            count = count + 1
        until sim.getSystemTime() - began > 0.3
        best = math.min(best, (sim.getSystemTime() - began) / count)
    end
    return 1000 * best
end

function sysCall_init()
    scene()
    for _, case in ipairs(CASES) do
        local name, width, height, cameras, masks = table.unpack(case)
        local sensors = {}
        for i = 1, cameras do
            sensors[#sensors + 1] = sensor(width, height, (i - 1) / 4)
            if masks then sensors[#sensors + 1] = sensor(width, height, (i - 1) / 4, true) end
        end
        print(name, measure(sensors))
        sim.removeObjects(sensors)
    end
end
