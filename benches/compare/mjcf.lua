-- Lets a robot in MJCF move and prints where its joints, its free bodies and its centre of mass are. FILE, GRAVITY, SECONDS, STEP, CONTACTS, TARGETS, FIRST, FREE come before.
sim = require 'sim'

local joints, bodies, free = {}, {}, {}

local function poses()
    local parts = {}
    for _, body in ipairs(free) do
        local numbers = sim.getObjectPose(body[2])
        for i = 1, 7 do numbers[i] = string.format('%.12g', numbers[i]) end
        parts[#parts + 1] = body[1] .. '=' .. table.concat(numbers, ',')
    end
    return table.concat(parts, ' ')
end

local function drive(joint, value)
    local control = sim.getObjectInt32Param(joint, sim.jointintparam_dynctrlmode)
    if control == sim.jointdynctrl_force then
        sim.setJointTargetForce(joint, value)
    elseif control == sim.jointdynctrl_velocity then
        sim.setJointTargetVelocity(joint, value)
    else
        sim.setJointTargetPosition(joint, value)
    end
end

function sysCall_init()
    sim.setArrayParam(sim.arrayparam_gravity, GRAVITY)
    sim.setFloatParam(sim.floatparam_simulation_time_step, 2 * STEP)
    sim.setFloatParam(sim.floatparam_physicstimestep, STEP)
    -- Of two frictions the larger one counts.
    sim.setInt32Param(sim.intparam_dynamic_engine, sim.physics_mujoco)
    local root = sim.loadModel(FILE)
    for _, joint in ipairs(sim.getObjectsInTree(sim.handle_scene, sim.sceneobject_joint)) do
        local name = sim.getObjectAlias(joint)
        if sim.getJointType(joint) ~= sim.joint_spherical_subtype then
            joints[#joints + 1] = {name, joint}
            if FIRST[name] then sim.setJointPosition(joint, FIRST[name]) end
            if TARGETS[name] then drive(joint, TARGETS[name]) end
        end
    end
    for _, shape in ipairs(sim.getObjectsInTree(root, sim.sceneobject_shape)) do
        if sim.getObjectInt32Param(shape, sim.shapeintparam_static) == 0 and string.find(sim.getObjectAlias(shape), '_respondable$') then
            local _, frame = sim.getShapeInertia(shape)
            bodies[#bodies + 1] = {shape, sim.getShapeMass(shape), {frame[4], frame[8], frame[12]}}
        end
        local name = string.match(sim.getObjectAlias(shape), '^(.*)_respondable$')
        if name and FREE[name] then free[#free + 1] = {name, shape} end
        if not CONTACTS then sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0) end
    end
    print('START ' .. poses())
end

function sysCall_sensing()
    local mass, sum, parts = 0, {0, 0, 0}, {}
    for _, body in ipairs(bodies) do
        local at = sim.multiplyVector(sim.getObjectMatrix(body[1]), body[3])
        mass = mass + body[2]
        for i = 1, 3 do sum[i] = sum[i] + body[2] * at[i] end
    end
    for _, joint in ipairs(joints) do parts[#parts + 1] = string.format('%s=%.12g', joint[1], sim.getJointPosition(joint[2])) end
    local time = sim.getSimulationTime() + sim.getSimulationTimeStep()
    print(string.format('ROW %.9g %.12g %.12g %.12g %.9g %s', time, sum[1] / mass, sum[2] / mass, sum[3] / mass, mass, table.concat(parts, ' ')))
    if time > SECONDS then print('END ' .. poses()) end
    if time > SECONDS then sim.stopSimulation() end
end
