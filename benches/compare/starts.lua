-- Reads the robot FILE, holds its base and starts ROUNDS times. In each round: the seconds until the second step has ended (`START`), the seconds of a step of
-- 50 ms at rest (`REST`), and while all joints move by 0.8 rad at up to 2 rad/s (`MOVES`).
sim, simURDF = require 'sim', require 'simURDF'

local STEPS <const>, WAY <const>, SPEED <const> = 100, 0.4, 2.0

local function seconds(steps, before)
    local start = sim.getSystemTime()
    for _ = 1, steps do
        if before then before() end
        sim.step()
    end
    return (sim.getSystemTime() - start) / steps
end

local function jointsOf(root)
    local joints = {}
    for _, joint in ipairs(sim.getObjectsInTree(root, sim.object_joint_type)) do
        if sim.getJointMode(joint) == sim.jointmode_dynamic then joints[#joints + 1] = joint end
    end
    return joints
end

local function hold(joints)
    local home = {}
    for i, joint in ipairs(joints) do
        home[i] = sim.getJointPosition(joint)
        sim.setIntProperty(joint, 'dynCtrlMode', sim.jointdynctrl_position)
        sim.setObjectFloatParam(joint, sim.jointfloatparam_maxvel, SPEED)
        sim.setJointTargetForce(joint, 300)
        sim.setJointTargetPosition(joint, home[i])
    end
    return home
end

local function round(joints)
    local start = sim.getSystemTime()
    sim.startSimulation()
    sim.step()
    sim.step()
    print('START ' .. sim.getSystemTime() - start)
    local home = hold(joints)
    print('REST ' .. seconds(STEPS))
    print('MOVES ' .. seconds(STEPS, function()
        local at = WAY * math.sin(SPEED / WAY * sim.getSimulationTime())
        for i, joint in ipairs(joints) do sim.setJointTargetPosition(joint, home[i] + at) end
    end))
    sim.stopSimulation(true)
end

function sysCall_thread()
    local start = sim.getSystemTime()
    local _, roots = simURDF.import(FILE, 0)
    print('IMPORT ' .. sim.getSystemTime() - start)
    sim.setStepping(true)
    for _, shape in ipairs(sim.getObjectsInTree(roots[1], sim.object_shape_type, 2)) do
        sim.setBoolProperty(shape, 'dynamic', false)
    end
    for _ = 1, ROUNDS do round(jointsOf(roots[1])) end
    sim.quitSimulator()
end
