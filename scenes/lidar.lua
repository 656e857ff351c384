-- A scanner with one ray turns in a room, as the laser of a Hokuyo does, and draws what it has measured.
--
--     swanilda run scenes/lidar.lua
--     swanilda render scenes/lidar.lua --time 1 -o lidar.png

sim = require 'sim'

local BEAMS = 180
local RANGE = 5 -- metres
local ROOM = {4, 3} -- metres along x and y
local COLUMNS, ROWS = 61, 25 -- of the drawing

local sensor
local scan = {} -- a point per beam that met something, in the world

local function block(alias, size, position)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectAlias(shape, alias)
    sim.setObjectPosition(shape, position)
end

local function room()
    local x, y = table.unpack(ROOM)
    for _, side in ipairs {-1, 1} do
        block('Wall', {0.1, y + 0.1, 0.5}, {side * x / 2, 0, 0.25})
        block('Wall', {x + 0.1, 0.1, 0.5}, {0, side * y / 2, 0.25})
    end
    block('Crate', {0.5, 0.5, 0.5}, {1.2, 0.6, 0.25})
    local pillar = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.4, 0.4, 0.5})
    sim.setObjectAlias(pillar, 'Pillar')
    sim.setObjectPosition(pillar, {-1, -0.5, 0.25})
end

-- A ray along z, which a script handles itself: once for each beam.
local function scanner()
    local numbers, lengths = {32, 32, 1, 16, 1, 1, 0, 0}, {0, RANGE, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.02, 0, 0}
    sensor = sim.createProximitySensor(sim.proximitysensor_ray, 16, 1, numbers, lengths)
    sim.setObjectAlias(sensor, 'Lidar')
end

function sysCall_init()
    room()
    scanner()
end

-- Turns the ray, measures, and remembers where it ended.
local function measure(angle)
    local cos, sin = math.cos(angle), math.sin(angle)
    -- The columns are the axes of the sensor; the last one is where it looks.
    sim.setObjectMatrix(sensor, {0, -sin, cos, 0, 0, cos, sin, 0, -1, 0, 0, 0.2})
    local result, distance = sim.handleProximitySensor(sensor)
    if result > 0 then table.insert(scan, {distance * cos, distance * sin}) end
    return result > 0 and distance or math.huge
end

local function draw()
    local rows = {}
    for row = 1, ROWS do
        rows[row] = {}
        for column = 1, COLUMNS do rows[row][column] = ' ' end
    end
    local function put(x, y, mark)
        local column = math.floor((x / (ROOM[1] + 0.2) + 0.5) * (COLUMNS - 1) + 1.5)
        local row = math.floor((0.5 - y / (ROOM[2] + 0.2)) * (ROWS - 1) + 1.5)
        rows[row][column] = mark
    end
    for _, point in ipairs(scan) do put(point[1], point[2], '*') end
    put(0, 0, 'o')
    for row = 1, ROWS do print((table.concat(rows[row]):gsub(' +$', ''))) end
end

function sysCall_sensing()
    if #scan > 0 then return end -- one turn is enough; the simulation ends after a few more steps
    local nearest, direction = math.huge, 0
    for beam = 0, BEAMS - 1 do
        local angle = 2 * math.pi * beam / BEAMS
        local distance = measure(angle)
        if distance < nearest then nearest, direction = distance, angle end
    end
    draw()
    print(string.format('%d of %d beams ended; the nearest after %.2f m, at %.0f degrees.', #scan, BEAMS, nearest,
        math.deg(direction)))
    sim.stopSimulation()
end
