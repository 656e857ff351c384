-- as: simulation
-- passes: 45
-- spec: joints 6, motion 1; kinematic motions: velocities to begin with, ends, limits, what is too small to move for
-- tol: 1e-6
-- topic: joints
sim = require 'sim'

local function prismatic(low, range)
    local joint = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
    sim.setJointInterval(joint, false, {low or -5, range or 10})
    return joint
end

local function revolute() return sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0) end

local shown = {} -- name -> joint and the steps to print

local function show(name, joint, ...)
    shown[#shown + 1] = {name = name, joint = joint, steps = {...}}
    return joint
end

function sysCall_init()
    -- From -0.5 to 0.5 m/s with 2 m/s^2 and 20 m/s^3: 0.6 s. After 0.1 s x = -0.5 * 0.1 + 20 * 0.1^3 / 6 = -0.046667, v = -0.4;
    -- after 0.3 s x = -0.046667 - 0.4 * 0.2 + 2 * 0.2^2 / 2 = -0.086667, v = 0; after 0.6 s x = 0; then 0.025 m each step.
    sim.setJointTargetVelocity(show('turns back', prismatic(), 2, 6, 12, 13), 0.5, {2, 20}, -0.5)
    sim.setJointTargetVelocity(show('as fast already', prismatic(), 1, 2, 3), 0.5, {2, 20}, 0.5)
    -- From 0 to 0.95 m/s: 0.575 s and 0.95 * 0.575 / 2 m; the other 0.025 s of step 12 at full speed: 0.296875 m,
    -- and 0.1 ms more, as the end is noticed one base cycle late.
    sim.setJointTargetVelocity(show('within a step', prismatic(), 11, 12, 13), 0.95, {2, 20})
    sim.setJointTargetVelocity(show('to the upper limit', prismatic(-1, 1.06), 1, 2, 3), 1, {}, 1)
    sim.setJointTargetVelocity(show('to the lower limit', prismatic(-0.06, 1), 1, 2, 3), -1, {}, -1)
    cyclic = show('around', revolute(), 1, 2)
    sim.setJointPosition(cyclic, 3.1)
    sim.setJointTargetVelocity(cyclic, 1, {}, 1)
    sim.setJointTargetVelocity(show('no velocity', prismatic(), 1, 5), 0, {2, 20})
    sim.setJointTargetPosition(show('0.05 mm', prismatic(), 1, 5), 0.00005, {1, 1, 1})
    sim.setJointTargetPosition(show('0.2 mm', prismatic(), 30), 0.0002, {1, 1, 1})
    sim.setJointTargetPosition(show('0.006 degrees', revolute(), 1, 5), 0.0001, {1, 1, 1})
    sim.setJointTargetPosition(show('0.02 degrees', revolute(), 30), 0.00035, {1, 1, 1})
    sim.setJointTargetPosition(show('impossible', prismatic(), 1, 5), 1, {1, 0, 1})
    sim.setJointTargetVelocity(show('impossible velocity', prismatic(), 1, 5), 1, {0, 1})
    local property = show('impossible by property', prismatic(), 1, 5)
    sim.setFloatArrayProperty(property, 'maxVelAccelJerk', {1, 1, math.huge})
    sim.setJointTargetPosition(property, 1)
    property = show('impossible velocity by property', prismatic(), 1, 5)
    sim.setFloatArrayProperty(property, 'maxVelAccelJerk', {1, 1, math.huge})
    sim.setJointTargetVelocity(property, 1)
    -- Cancelled after step 5 and begun anew: at rest again. From 0 to 0.2 m/s with 2 m/s^2 and 20 m/s^3: 0.2 s and 0.02 m, halfway 0.1 m/s.
    cancelled = show('begun anew', prismatic(), 4, 5, 7, 9, 10)
    sim.setJointTargetVelocity(cancelled, 0.2, {2, 20})
    reached = show('a target on the way', prismatic(), 10, 44)
    sim.setJointTargetPosition(reached, 1, {0.5, 1, 10})
end

local step = 0

function sysCall_actuation()
    if step == 5 then
        sim.setJointMode(cancelled, sim.jointmode_dynamic, 0)
        sim.setJointMode(cancelled, sim.jointmode_kinematic, 0)
        sim.setJointTargetVelocity(cancelled, 0.2, {2, 20})
    elseif step == 10 then
        sim.setJointTargetPosition(reached, sim.getJointPosition(reached), {0.5, 1, 10}) -- it has to come back
    end
end

function sysCall_sensing()
    step = step + 1
    for _, entry in ipairs(shown) do
        for _, wanted in ipairs(entry.steps) do
            if step == wanted then
                print(step, entry.name, string.format('%.7f %.7f', sim.getJointPosition(entry.joint), sim.getJointVelocity(entry.joint)))
            end
        end
    end
    if step == 35 then
        for _, entry in ipairs(shown) do print(entry.name, 'ended', sim.setJointPosition(entry.joint, 0) == 1) end
    end
end
