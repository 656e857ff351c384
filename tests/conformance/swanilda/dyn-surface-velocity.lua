-- topic: dynamics
-- as: simulation
-- passes: 160
-- engine: bullet278
-- spec: dynamics 8; a static box that is reset with an initial velocity carries what lies on it, and stays where it is
sim = require 'sim'

local belt, box, roller, pose
local VELOCITY <const> = 0.2

local function drive(velocity)
    sim.resetDynamicObject(belt)
    sim.setObjectFloatParam(belt, sim.shapefloatparam_init_velocity_x, velocity)
end

local function shape(kind, sizes, position, static)
    local handle = sim.createPrimitiveShape(kind, sizes)
    sim.setObjectInt32Param(handle, sim.shapeintparam_static, static and 1 or 0)
    sim.setObjectInt32Param(handle, sim.shapeintparam_respondable, 1)
    sim.setObjectPosition(handle, position)
    return handle
end

function sysCall_init()
    belt = shape(sim.primitiveshape_cuboid, {4, 0.6, 0.1}, {0, 0, 0.5}, true)
    box = shape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}, {-1, 0, 0.6}, false)
    pose = sim.getObjectPose(belt)
end

local function isStill()
    local now = sim.getObjectPose(belt)
    for i = 1, 7 do if now[i] ~= pose[i] then return false end end
    return true
end

local step = 0
function sysCall_actuation()
    step = step + 1
    -- A conveyor resets its box in each step; the velocity holds until the next reset.
    if step <= 20 then drive(VELOCITY) end
    if step == 100 then drive(0) end
end

function sysCall_sensing()
    local velocity, x = sim.getObjectVelocity(box), sim.getObjectPosition(box)[1]
    if step == 20 then print('carried', math.abs(velocity[1] - VELOCITY) < 0.01) end
    if step == 90 then
        print('further', math.abs(velocity[1] - VELOCITY) < 0.01, math.abs(x + 1 - VELOCITY * 4.5) < 0.05)
    end
    if step == 120 then at = x end
    if step == 160 then
        print('stopped', math.abs(velocity[1]) < 0.001, math.abs(x - at) < 0.001)
        print('belt', isStill(), math.abs(sim.getObjectPosition(box)[3] - 0.6) < 0.001)
    end
end
