-- as: customization
-- passes: 12
-- spec: dynamics 12; particles are emitted, are refused, push a body, are seen by a vision sensor that sees paint, and let sub-steps happen
-- topic: dynamics
sim = require 'sim'

local RESPONDABLE = sim.particle_respondable1to4 + sim.particle_respondable5to8
local passes = 0

local function fails(...) print(select(2, pcall(...)):match('[^:]*$')) end

function sysCall_init()
    sim.setArrayParam(sim.arrayparam_gravity, {0, 0, 0})
    -- no object, no type, no parameters, no item, no handle
    fails(sim.addParticleObject, 31, 0.1, 1000, nil, 0, 10)
    fails(sim.addParticleObject, sim.particle_spheres, 0 / 0, 1000, nil, 0, 10)
    fails(sim.addParticleObject, sim.particle_spheres, 0.1, 1000, {1, 'x', 2}, 0, 10)
    fails(sim.addParticleObjectItem, 99, {0, 0, 0, 0, 0, 0})
    fails(sim.removeParticleObject, 99)
    local kind = sim.particle_spheres + RESPONDABLE + sim.particle_ignoresgravity + sim.particle_painttag
    few = sim.addParticleObject(kind, 0.02, 1000, {2, 1, 0.5, 0, 0}, 0, 2, {1, 0, 0}, nil, {0, 0, 0}, {0, 0, 0})
    print(sim.addParticleObjectItem(few, {1, 2, 3}), sim.addParticleObjectItem(few, {0 / 0, 0, 0, 0, 0, 0}))
    -- a wall moves on when it is hit
    for i = 0, 2 do print('emitted', sim.addParticleObjectItem(few, {0, 0, 0.02 * i, 5, 0, 0})) end
    -- in front of a vision sensor
    still = sim.addParticleObject(sim.particle_spheres + sim.particle_ignoresgravity + sim.particle_painttag, 0.2, 1000, nil, 0.2, 1, {1, 0, 0})
    print('emitted', sim.addParticleObjectItem(still, {0, 3, 1, 0, 0, 0}))
    eye = sim.createVisionSensor(1 | 2, {16, 16, 0, 0}, {0.01, 10, 0.5, 0.1, 0, 0, 0, 0, 0, 0, 0})
    sim.setObjectPosition(eye, {0, 3, 0})
end

function sysCall_dyn(data) if data.afterStep then passes = passes + 1 end end

local steps = 0

function sysCall_sensing()
    steps = steps + 1
    if steps == 1 then
        print('passes without bodies', passes)
        body = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 1, 1})
        sim.setObjectPosition(body, {1, 0, 0})
        sim.setShapeMass(body, 1)
        sim.setObjectInt32Param(body, sim.shapeintparam_static, 0)
        sim.setObjectInt32Param(body, sim.shapeintparam_respondable, 1)
    end
    if steps == 2 or steps == 6 then
        sim.handleVisionSensor(eye)
        local image = sim.getVisionSensorImg(eye)
        print('red in the middle', image:byte(3 * (8 * 16 + 8) + 1) > 50)
    end
    if steps == 8 then
        -- two particles of 1000 pi / 6 0.02^3 kg at 5 m/s, stopped
        local expected = 2 * 1000 * math.pi / 6 * 0.02 ^ 3 * 5
        print('pushed', math.abs(sim.getVelocity(body)[1] / expected - 1) < 0.02)
        print(sim.addParticleObjectItem(few, nil), sim.removeParticleObject(few))
        fails(sim.removeParticleObject, few)
        sim.removeParticleObject(sim.handle_all)
    end
end
