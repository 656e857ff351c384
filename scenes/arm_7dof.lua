-- A seven-joint arm in dynamic position control: its motors follow a smooth motion, and the errors are what physics leaves.
--
--     swanilda run scenes/arm_7dof.lua

sim = require 'sim'

local JOINTS, LENGTH = 7, 0.16 -- metres between joints
local AMPLITUDE, PERIOD = math.rad(35), 4 -- seconds

-- Joints 1, 3, 5 and 7 turn about the arm, the others bend it.
local function orientation(i)
    return i % 2 == 1 and {0, 0, 0} or {-math.pi / 2, 0, 0}
end

local function segment(i, parent)
    local base = LENGTH * i
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(joint, 'J' .. i)
    sim.setObjectPosition(joint, {0, 0, base})
    sim.setObjectOrientation(joint, orientation(i))
    sim.setObjectParent(joint, parent, true)
    sim.setJointInterval(joint, false, {-math.rad(170), math.rad(340)})
    sim.setIntProperty(joint, 'dynCtrlMode', sim.jointdynctrl_position)
    sim.setJointTargetForce(joint, 200)

    local link = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.06, 0.06, LENGTH - 0.02})
    sim.setObjectAlias(link, 'Link' .. i)
    sim.setObjectPosition(link, {0, 0, base + LENGTH / 2})
    sim.setShapeMass(link, 2.5 - 0.3 * i)
    sim.setObjectParent(link, joint, true)
    sim.setBoolProperty(link, 'dynamic', true)
    return joint, link
end

-- Where joint i should be at time t: a sine that starts gently.
local function wanted(i, t)
    local gently = math.min(1, t / 1)
    return gently * AMPLITUDE * math.sin(2 * math.pi * t / PERIOD + i)
end

function sysCall_init()
    local base = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {0.2, 0.2, LENGTH})
    sim.setObjectAlias(base, 'Base')
    sim.setObjectPosition(base, {0, 0, LENGTH / 2})
    joints = {}
    local parent = base
    for i = 1, JOINTS do joints[i], parent = segment(i, parent) end
    tip = sim.createDummy(0.02)
    sim.setObjectAlias(tip, 'Tip')
    sim.setObjectPosition(tip, {0, 0, LENGTH * (JOINTS + 1)})
    sim.setObjectParent(tip, parent, true)
    worst = 0
end

function sysCall_actuation()
    local t = sim.getSimulationTime()
    for i, joint in ipairs(joints) do sim.setJointTargetPosition(joint, wanted(i, t)) end
end

function sysCall_sensing()
    local t = sim.getSimulationTime()
    local sum = 0
    for i, joint in ipairs(joints) do
        local e = math.abs(wanted(i, t) - sim.getJointPosition(joint))
        sum = sum + e
        worst = math.max(worst, e)
    end
    if (t + 1e-6) % 1 < 2e-6 then
        local p = sim.getObjectPosition(tip)
        print(string.format('t = %.0f s   tip (%6.3f, %6.3f, %6.3f)   mean error %.2f deg', t, p[1], p[2], p[3],
            math.deg(sum / JOINTS)))
    end
    if t >= 8 and not done then
        done = true
        print(string.format('Worst tracking error: %.1f deg.', math.deg(worst)))
        sim.stopSimulation()
    end
end
