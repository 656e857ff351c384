-- topic: old functions
-- as: main
-- passes: 60
-- spec: vrep-era 2.3; joints 6; kinematic joints under a main script of its own: no script of the scene moves them
-- tol: 1e-9
sim = require 'sim'

local toPlace, atSpeed, tagged

local function joint(kind)
    local handle = sim.createJoint(kind, sim.jointmode_kinematic, 0)
    sim.setJointInterval(handle, false, {-5, 10})
    return handle
end

local function refused(call, ...)
    local ok, text = pcall(call, ...)
    print(ok and 'accepted' or text:match('in .*') or text)
end

function sysCall_init()
    sim.handleSimulationStart()
    toPlace, atSpeed, tagged = joint(sim.joint_revolute), joint(sim.joint_prismatic), joint(sim.joint_revolute)
    sim.setExplicitHandling(tagged, 1)
    sim.setJointTargetPosition(toPlace, 0.5, {0.5, 2, 20})
    sim.setJointTargetVelocity(atSpeed, 0.2, {1, 10})
    sim.setJointTargetPosition(tagged, 0.5, {0.5, 2, 20})
end

local step = 0
function sysCall_actuation()
    step = step + 1
    if step <= 10 then
        sim.handleJointMotion()
    else
        simHandleJoint(sim.handle_all_except_explicit, sim.getSimulationTimeStep())
    end
    if step == 10 or step == 59 then
        print(step, sim.getJointPosition(toPlace), sim.getJointPosition(atSpeed), sim.getJointPosition(tagged))
    end
    if step == 59 then
        print(simHandleJoint(tagged, 0.05), sim.getJointPosition(tagged))
        print(simResetJoint(sim.handle_all), simHandleJoint(sim.handle_all, 0.05), sim.getJointPosition(atSpeed))
        refused(simHandleJoint, toPlace, 0.05)
        refused(simResetJoint, 77777)
        refused(simHandleJoint, sim.handle_all, 0 / 0)
    end
end

function sysCall_sensing() end
function sysCall_cleanup() end
