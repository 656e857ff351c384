-- What slides over seams in one plane does not notice them: tiles, a group of boxes, the inner edges of a mesh and of a height field.
local bench = require 'lib.bench'

local FRICTION <const> = 0.05
local PITCH <const> = 0.4

local function tiles(y)
    local made = {}
    for column = -10, 9 do
        made[#made + 1] = bench.body{size = {PITCH, PITCH, 0.1}, at = {(column + 0.5) * PITCH, y, -0.05}, fixed = true, solid = true, friction = 1}
    end
    return made
end

local function flat(y)
    local count, vertices, indices = 40, {}, {}
    for row = 0, 2 do
        for column = 0, count do
            for _, x in ipairs{(column / count - 0.5) * 8, y + (row - 1) * 0.2, 0} do vertices[#vertices + 1] = x end
        end
    end
    for row = 0, 1 do
        for column = 0, count - 1 do
            local a = row * (count + 1) + column
            for _, index in ipairs{a, a + 1, a + count + 2, a, a + count + 2, a + count + 1} do indices[#indices + 1] = index end
        end
    end
    return sim.createShape(0, 0, vertices, indices)
end

local function field(y)
    local heights = {}
    for i = 1, 3 * 41 do heights[i] = 0 end
    local made = sim.createHeightfieldShape(0, 0, 41, 3, 8, heights)
    sim.setObjectPosition(made, {0, y, sim.getObjectPosition(made)[3]})
    return made
end

local function made(shape)
    sim.setBoolProperty(shape, 'dynamic', false)
    sim.setBoolProperty(shape, 'respondable', true)
    sim.setEngineFloatParam(sim.bullet_body_oldfriction, shape, 1)
end

local FLOORS <const> = {
    tiles = tiles,
    group = function(y) made(sim.groupShapes(tiles(y), false)) end,
    mesh = function(y) made(flat(y)) end,
    ['height field'] = function(y) made(field(y)) end,
}
-- Kind of shape, and size.
local SLIDERS <const> = {box = {'cuboid', {0.2, 0.2, 0.1}}, disc = {'cylinder', {0.2, 0.2, 0.1}}}

local runs, y = {}, -20
for _, floor in ipairs{'tiles', 'group', 'mesh', 'height field'} do
    for _, name in ipairs{'box', 'disc'} do
        for _, speed in ipairs{1, 3} do
            FLOORS[floor](y)
            local kind, size = table.unpack(SLIDERS[name])
            local body = bench.body{kind = sim['primitiveshape_' .. kind], size = size, at = {-3.1, y, 0.05}, mass = 1, solid = true, friction = FRICTION}
            sim.setObjectFloatParam(body, sim.shapefloatparam_init_velocity_x, speed)
            runs[#runs + 1] = {what = ('%s over %s at %d m/s'):format(name, floor, speed), body = body, speed = speed, hop = 0, at = {}}
            y = y + 1
        end
    end
end
FLOORS.mesh(y)
local ball = bench.body{kind = sim.primitiveshape_spheroid, size = {0.1, 0.1, 0.1}, at = {-3.1, y, 0.05}, mass = 1, solid = true, friction = 1}
sim.setObjectFloatParam(ball, sim.shapefloatparam_init_velocity_x, 3)
sim.setObjectFloatParam(ball, sim.shapefloatparam_init_velocity_b, 60)

bench.run(function()
    local deceleration = FRICTION * bench.g
    while sim.getSimulationTime() < 1.5 do
        sim.step()
        for _, run in ipairs(runs) do
            run.hop = math.max(run.hop, math.abs(sim.getObjectPosition(run.body)[3] - 0.05))
        end
    end
    local t = sim.getSimulationTime()
    for _, run in ipairs(runs) do
        local way = run.speed * t - deceleration * t ^ 2 / 2
        bench.check(run.what .. ': way, m', sim.getObjectPosition(run.body)[1] + 3.1, way, 0.01 * way)
        bench.check('its largest hop, m', run.hop, 0, 1e-4)
    end
    bench.check('ball that rolls over a mesh at 3 m/s: way, m', sim.getObjectPosition(ball)[1] + 3.1, 3 * t, 0.03 * t)
end)
