-- A six-joint arm follows a moving target with inverse kinematics: simIK copies the chain, solves it in each step, and moves the joints.
--
--     swanilda run scenes/ik_arm.lua
--     swanilda render scenes/ik_arm.lua --camera /Camera --time 1.5 -o arm.png

sim = require 'sim'
simIK = require 'simIK'

local PERIOD = 8 -- seconds
local CENTRE, SIZE = {0.55, 0, 0.5}, {0.1, 0.35, 0.15} -- metres
-- Of each joint: its place in the frame of the one before, and how its axis is turned there.
local JOINTS = {
    {{0, 0, 0.1}, {0, 0, 0}}, {{0, 0, 0.15}, {-math.pi / 2, 0, 0}}, {{0.4, 0, 0}, {0, 0, 0}},
    {{0.4, 0, 0}, {0, 0, 0}}, {{0, 0, 0}, {math.pi / 2, 0, 0}}, {{0, 0, 0}, {0, math.pi / 2, 0}},
}
local START = {0, -1.2, 1.6, -0.4, 0, 0}

local function coloured(shape, parent, position, colour, orientation)
    sim.setObjectParent(shape, parent, true)
    sim.setObjectPosition(shape, position, parent)
    sim.setObjectOrientation(shape, orientation or {0, 0, 0}, parent)
    sim.setShapeColor(shape, nil, sim.colorcomponent_ambient_diffuse, colour)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
end

local function rod(length)
    return sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.06, 0.06, length})
end

local function build()
    base = sim.createDummy(0.02)
    sim.setObjectAlias(base, 'Base')
    coloured(sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.2, 0.2, 0.1}), base, {0, 0, 0.05}, {0.25, 0.25, 0.28})
    local parent = base
    for i, place in ipairs(JOINTS) do
        local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
        sim.setObjectAlias(joint, 'J' .. i)
        sim.setJointInterval(joint, false, {-math.rad(170), math.rad(340)})
        sim.setObjectParent(joint, parent, true)
        sim.setObjectMatrix(joint, sim.buildMatrix(place[1], place[2]), parent)
        coloured(sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.09, 0.09, 0.1}), joint, {0, 0, 0}, {0.15, 0.35, 0.7})
        if i == 2 or i == 3 then coloured(rod(0.4), joint, {0.2, 0, 0}, {0.85, 0.85, 0.88}, {0, math.pi / 2, 0}) end
        sim.setJointPosition(joint, START[i])
        parent = joint
    end
    coloured(sim.createPrimitiveShape(sim.primitiveshape_cone, {0.05, 0.05, 0.1}), parent, {0, 0, 0.1}, {0.9, 0.6, 0.1})
    tip = sim.createDummy(0.02)
    sim.setObjectAlias(tip, 'Tip')
    sim.setObjectParent(tip, parent, true)
    sim.setObjectPose(tip, {0, 0, 0.15, 0, 0, 0, 1}, parent)
    target = sim.createDummy(0.02)
    sim.setObjectAlias(target, 'Target')
    coloured(sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.06, 0.06, 0.06}), target, {0, 0, 0}, {0.85, 0.1, 0.1})
end

-- A lying eight in front of the arm; the tool points down and forwards.
local function moveTarget(t)
    local a = 2 * math.pi * t / PERIOD
    local x = CENTRE[1] + SIZE[1] * math.cos(a)
    local position = {x, CENTRE[2] + SIZE[2] * math.sin(a), CENTRE[3] + SIZE[3] * math.sin(2 * a)}
    sim.setObjectMatrix(target, sim.buildMatrix(position, {0, math.rad(120), 0}))
end

-- Looks along its z axis, with y up; handled explicitly, so that it takes pictures only where one is asked for.
local function addCamera()
    local camera = sim.createVisionSensor(1 + 2 + 128, {480, 360, 0, 0}, {0.1, 10, math.rad(50), 0.05, 0, 0, 0.8, 0.85, 0.9, 0, 0})
    sim.setObjectAlias(camera, 'Camera')
    sim.setObjectPose(camera, sim.buildPose({1.5, 1, 0.95}, {-1.2, -1, -0.5}, 9, {0, 0, 1}))
end

function sysCall_init()
    build()
    addCamera()
    moveTarget(0)
    env = simIK.createEnvironment()
    group = simIK.createGroup(env)
    simIK.setGroupCalculation(env, group, simIK.method_damped_least_squares, 0.02, 20)
    simIK.addElementFromScene(env, group, base, tip, target, simIK.constraint_pose)
    worst, failures, done = 0, 0, false
end

function sysCall_actuation()
    moveTarget(sim.getSimulationTime())
    local result, flags, precision = simIK.handleGroup(env, group, {syncWorlds = true, allowError = true})
    if result ~= simIK.result_success then failures = failures + 1 end
    if sim.getSimulationTime() > 1 then worst = math.max(worst, precision[1]) end
end

function sysCall_sensing()
    local t = sim.getSimulationTime()
    if (t + 1e-6) % 1 < 2e-6 then
        local p = sim.getObjectPosition(tip)
        print(string.format('t = %.0f s   tip (%6.3f, %6.3f, %6.3f)   missed %d times', t, p[1], p[2], p[3], failures))
    end
    if t > PERIOD - 0.01 and not done then
        done = true
        print(string.format('largest error after the first second: %.2f mm', worst * 1000))
        sim.stopSimulation()
    end
end

function sysCall_cleanup() simIK.eraseEnvironment(env) end
