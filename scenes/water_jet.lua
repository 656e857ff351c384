-- A jet of water: particles that fall, splash and push a barrel over.
--
--     swanilda view scenes/water_jet.lua
--     swanilda run scenes/water_jet.lua --time 4 --video jet.webp

sim = require 'sim'

local PER_STEP, SPEED = 60, 4 -- particles, m/s
local SIZE, DENSITY = 0.02, 1000 -- metres, kg/m3
local WHERE, DIRECTION = {0, 0, 0.6}, {math.cos(0.35), 0, math.sin(0.35)}

local function shape(kind, size, at, colour)
    local handle = sim.createPrimitiveShape(kind, size)
    sim.setObjectPosition(handle, at)
    sim.setShapeColor(handle, nil, sim.colorcomponent_ambient_diffuse, colour)
    sim.setObjectInt32Param(handle, sim.shapeintparam_respondable, 1)
    return handle
end

--- Lets particles bounce: Bullet multiplies the restitutions of both sides.
local function lively(handle)
    sim.setEngineFloatParam(sim.bullet_body_restitution, handle, 0.6)
end

function sysCall_init()
    local floor = shape(sim.primitiveshape_cuboid, {6, 3, 0.1}, {1.5, 0, -0.05}, {0.6, 0.6, 0.6})
    lively(floor)
    shape(sim.primitiveshape_cuboid, {0.3, 0.3, 0.5}, {-0.2, 0, 0.25}, {0.3, 0.35, 0.4})
    barrel = shape(sim.primitiveshape_cylinder, {0.3, 0.3, 0.6}, {1.6, 0, 0.3}, {0.8, 0.4, 0.2})
    sim.setObjectAlias(barrel, 'Barrel')
    sim.setShapeMass(barrel, 2)
    sim.setObjectInt32Param(barrel, sim.shapeintparam_static, 0)
    lively(barrel)
    local kind = sim.particle_spheres | sim.particle_respondable1to4 | sim.particle_respondable5to8 | sim.particle_cyclic
    -- Two parameters: friction (0) and restitution (1) with Bullet.
    local parameters = {2, 0, 0.1, 1, 0.5}
    water = sim.addParticleObject(kind, SIZE, DENSITY, parameters, 2, 5000, {0.35, 0.6, 0.95})
end

function sysCall_actuation()
    for i = 1, PER_STEP do
        local item = {}
        for axis = 1, 3 do
            -- Spread over the way that the jet goes in a step, at whose end they have left the nozzle.
            local way = SPEED * sim.getSimulationTimeStep() * (i / PER_STEP - 1)
            item[axis] = WHERE[axis] + DIRECTION[axis] * way + 0.02 * (sim.getRandom() - 0.5)
            item[axis + 3] = DIRECTION[axis] * SPEED + 0.15 * (sim.getRandom() - 0.5)
        end
        sim.addParticleObjectItem(water, item)
    end
end

local steps = 0

function sysCall_sensing()
    steps = steps + 1
    if steps % 10 == 0 then
        local axis = sim.getObjectMatrix(barrel)[11] -- the height of its axis
        local lean = math.deg(math.acos(math.max(-1, math.min(1, axis))))
        print(string.format('After %.2f s the barrel leans by %.0f degrees.', sim.getSimulationTime(), lean))
    end
end
