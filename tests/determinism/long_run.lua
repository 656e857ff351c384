-- 10 000 steps of one sub-step each: a pile, an arm with motors that pushes a box, and a chain that lies on the floor.
-- Every run of the simulation prints a hash of all poses and velocities of its steps, after a fifth of them and after all.
sim = require 'sim'

local FIRST_STEPS, STEPS = 2000, 10000
local watched = {}

local function box(at, size, parent, static)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectPosition(shape, at)
    sim.setShapeMass(shape, 1)
    if parent then sim.setObjectParent(shape, parent, true) end
    sim.setBoolProperty(shape, 'dynamic', not static)
    sim.setBoolProperty(shape, 'respondable', true)
    watched[#watched + 1] = shape
    return shape
end

local function joint(at, turn, parent)
    local handle = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(handle, at)
    sim.setObjectOrientation(handle, turn)
    sim.setObjectParent(handle, parent, true)
    return handle
end

for i = 1, 3 do box({0.01 * i, 0, 0.12 * i}, {0.1, 0.1, 0.1}) end

local base = box({1, 0, 0.05}, {0.1, 0.1, 0.1}, nil, true)
local shoulder = joint({1, 0, 0.11}, {0, 0, 0}, base)
local upper = box({1.15, 0, 0.11}, {0.2, 0.04, 0.04}, shoulder)
local elbow = joint({1.3, 0, 0.11}, {0, 0, 0}, upper)
box({1.45, 0, 0.09}, {0.2, 0.04, 0.1}, elbow)
for _, motor in ipairs{shoulder, elbow} do
    sim.setIntProperty(motor, 'dynCtrlMode', sim.jointdynctrl_position)
    sim.setJointTargetForce(motor, 50)
end
box({1.4, 0.25, 0.05}, {0.1, 0.1, 0.1})

local link = box({-1, 0, 0.05}, {0.12, 0.04, 0.04})
for i = 1, 2 do
    local at = -1 + 0.15 * i
    link = box({at, 0, 0.05}, {0.12, 0.04, 0.04}, joint({at - 0.075, 0, 0.05}, {-math.pi / 2, 0, 0}, link))
end

local hash, steps

local function add(numbers)
    for _, number in ipairs(numbers) do
        local bits = string.unpack('<i8', string.pack('<d', number))
        hash = ((hash << 7 | hash >> 57) ~ bits) * 0x9E3779B97F4A7C15
    end
end

function sysCall_init()
    sim.setFloatParam(sim.floatparam_simulation_time_step, 0.005)
end

function sysCall_beforeSimulation()
    hash, steps = 0, 0
end

function sysCall_actuation()
    local t = sim.getSimulationTime()
    sim.setJointTargetPosition(shoulder, 0.8 * math.sin(2 * t))
    sim.setJointTargetPosition(elbow, 0.5 * math.sin(3 * t))
end

function sysCall_sensing()
    steps = steps + 1
    for _, shape in ipairs(watched) do
        local linear, angular = sim.getVelocity(shape)
        add(sim.getObjectPose(shape, -1))
        add(linear)
        add(angular)
    end
    if steps == FIRST_STEPS or steps == STEPS then
        print(string.format('%016x after %.1f s', hash, sim.getSimulationTime()))
    end
    if steps == STEPS then sim.stopSimulation() end
end
