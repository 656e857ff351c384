sim = require 'sim'

--[[
The main script of scenes without one of their own: one run of it is one simulation step.

Only lists the stages, in the order of 4.10; they are implemented natively.
]]

local handleEmbeddedScripts, handleAddOnScripts = sim.handleEmbeddedScripts, sim.handleAddOnScripts
local handleSandboxScript, handleSimulationScripts = sim.handleSandboxScript, sim.handleSimulationScripts
local handleJointMotion, handleDynamics = sim.handleJointMotion, sim.handleDynamics
local handlePath = simHandlePath
local handleSensingStart, handleSensors = sim.handleSensingStart, sim._handleSensors
local getTimeStep = sim.getSimulationTimeStep
local ACTUATION <const>, SENSING <const>, CLEANUP <const> = sim.syscb_actuation, sim.syscb_sensing, sim.syscb_cleanup
local SUSPEND <const>, SUSPENDED <const>, RESUME <const> = sim.syscb_suspend, sim.syscb_suspended, sim.syscb_resume
local NOT_EXPLICIT <const> = sim.handle_all_except_explicit

local function tellScripts(callback)
    handleEmbeddedScripts(callback)
    handleAddOnScripts(callback)
    handleSandboxScript(callback)
end

function sysCall_init() sim.handleSimulationStart() end

function sysCall_actuation()
    tellScripts(ACTUATION)
    handleJointMotion()
    local dt = getTimeStep()
    handlePath(NOT_EXPLICIT, dt)
    handleDynamics(dt, NOT_EXPLICIT)
end

function sysCall_sensing()
    handleSensingStart(NOT_EXPLICIT)
    handleSensors() -- those that are not handled explicitly
    tellScripts(SENSING)
end

function sysCall_cleanup()
    handleSimulationScripts(CLEANUP)
    sim.resetProximitySensor(NOT_EXPLICIT)
    sim.resetVisionSensor(NOT_EXPLICIT)
end

function sysCall_suspend() tellScripts(SUSPEND) end
function sysCall_suspended() tellScripts(SUSPENDED) end
function sysCall_resume() tellScripts(RESUME) end

---------------------------------------------------------------- kinematic joints that no other script moves

local BASE_CYCLE <const> = 0.0001
local motions = {} -- joint -> velocity and acceleration at the end of the last step

local function cycleOf(dt) return dt / math.max(1, math.floor(dt / BASE_CYCLE + 0.5)) end

local function ruckigStep(create, ...)
    local dt = getTimeStep()
    local isPossible, motion = pcall(create, 1, cycleOf(dt), -1, ...)
    if not isPossible then return -1 end -- limits nobody can keep, such as an infinite jerk
    local result, state, remaining = sim.ruckigStep(motion, dt)
    sim.ruckigRemove(motion)
    return result, state, remaining
end

local function finish(joint, position)
    motions[joint] = nil
    return {pos = position, vel = 0, accel = 0}
end

local function proceed(motion, position, velocity, acceleration)
    motion.vel, motion.accel = velocity, acceleration
    return {pos = position, vel = velocity, accel = acceleration}
end

local function moveToPosition(joint, data, motion)
    local tolerance = data.revolute and math.rad(0.01) or 0.0001
    if math.abs(data.error) <= tolerance and motion.vel == 0 and motion.accel == 0 then return finish(joint, data.pos) end
    local result, state = ruckigStep(
        sim.ruckigPos, {data.pos, motion.vel, motion.accel}, {data.maxVel, data.maxAccel, data.maxJerk}, {1},
        {data.pos + data.error, 0}
    )
    -- 4.10 drops the position of the step that arrives, so its joints stop a little before their targets; these do not.
    if result ~= 0 then return finish(joint, result > 0 and state[1] or data.pos) end
    return proceed(motion, state[1], state[2], state[3])
end

local function limited(data, position)
    if data.cyclic then return position end -- the engine wraps
    return math.max(data.lowLimit, math.min(data.highLimit, position))
end

local function moveAtVelocity(joint, data, motion)
    local target = data.targetVel
    if motion.vel == target and motion.accel == 0 then
        if target == 0 then return finish(joint, data.pos) end
        return proceed(motion, limited(data, data.pos + target * getTimeStep()), target, 0)
    end
    local result, state, remaining = ruckigStep(
        sim.ruckigVel, {data.pos, motion.vel, motion.accel}, {data.maxAccel, data.maxJerk}, {1}, {target}
    )
    if result < 0 then return finish(joint, data.pos) end
    if result == 0 then return proceed(motion, limited(data, state[1]), state[2], state[3]) end
    local position = limited(data, state[1] - target * math.min(0, remaining)) -- the rest of the step, at full speed
    if target == 0 then return finish(joint, position) end
    return proceed(motion, position, target, 0)
end

function sysCall_joint(data)
    if data.mode ~= sim.jointmode_kinematic then return end
    local joint = data.handle
    local motion = motions[joint]
    -- The engine knows no velocity at the start of a motion; a stored one is left over from a motion that was cancelled.
    if not motion or data.vel == 0 then
        motion = {vel = 0, accel = motion and motion.vel == 0 and motion.accel or 0}
        motions[joint] = motion
    end
    if data.initVel then motion.vel = data.initVel end
    if data.targetVel then return moveAtVelocity(joint, data, motion) end
    return moveToPosition(joint, data, motion)
end
