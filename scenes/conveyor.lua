-- A roller conveyor: every roller has its child script, a feeder drops parcels, a gate counts them.
--
--     swanilda run scenes/conveyor.lua

sim = require 'sim'

local ROLLERS, PITCH, RADIUS = 14, 0.09, 0.04 -- metres
local HEIGHT = 0.5

local DRIVE = [[
sim = require 'sim'

-- Each roller turns by its own script; all scripts have the same text.
function sysCall_init() motor = sim.getObject('..') end

function sysCall_actuation()
    local starting = math.min(1, sim.getSimulationTime()) -- a soft start
    sim.setJointTargetVelocity(motor, 8 * starting)
end
]]

local FEEDER = [[
sim = require 'sim'

local PARCELS, PERIOD = 5, 1.5
local dropped = 0

local function drop()
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.12})
    sim.setObjectAlias(h, 'Parcel')
    sim.setObjectPosition(h, sim.getObjectPosition(sim.getObject('..')))
    sim.setShapeMass(h, 1)
    sim.setBoolProperty(h, 'dynamic', true)
    sim.setBoolProperty(h, 'respondable', true)
    return h
end

function sysCall_actuation()
    -- Not in the very first step: scripts are initialised one after the other, and the gate may come later than this one.
    if dropped < PARCELS and sim.getSimulationTime() > dropped * PERIOD then
        dropped = dropped + 1
        sim.callScriptFunction('announce', sim.getObject('/Gate/script'), drop(), dropped)
    end
end
]]

local GATE = [[
sim = require 'sim'

local waiting, passed = {}, 0

-- Called by the feeder.
function announce(parcel, number) waiting[number] = parcel end

function sysCall_init() x = sim.getObjectPosition(sim.getObject('..'))[1] end

function sysCall_sensing()
    for number, parcel in pairs(waiting) do
        if sim.getObjectPosition(parcel)[1] > x then
            waiting[number] = nil
            passed = passed + 1
            print(string.format('t = %5.2f s   parcel %d has passed the gate', sim.getSimulationTime(), number))
        end
    end
    if passed == 5 or sim.getSimulationTime() >= 30 then
        print(passed .. ' parcels delivered.')
        sim.stopSimulation()
        passed = 0
        waiting = {}
    end
end
]]

local function attach(code, host) sim.setObjectParent(sim.createScript(sim.scripttype_simulation, code), host, false) end

local function place(alias, position)
    local h = sim.createDummy(0.02)
    sim.setObjectAlias(h, alias)
    sim.setObjectPosition(h, position)
    return h
end

local function roller(frame, x)
    local motor = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(motor, 'Motor')
    sim.setObjectPosition(motor, {x, 0, HEIGHT})
    sim.setObjectOrientation(motor, {-math.pi / 2, 0, 0})
    sim.setObjectParent(motor, frame, true)
    sim.setIntProperty(motor, 'dynCtrlMode', sim.jointdynctrl_velocity)
    sim.setJointTargetForce(motor, 5)
    sim.setJointTargetVelocity(motor, 0)

    local tube = sim.createPrimitiveShape(sim.primitiveshape_cylinder, {2 * RADIUS, 2 * RADIUS, 0.4})
    sim.setObjectAlias(tube, 'Roller')
    sim.setObjectPose(tube, sim.getObjectPose(motor))
    sim.setShapeMass(tube, 1)
    sim.setObjectParent(tube, motor, true)
    sim.setBoolProperty(tube, 'dynamic', true)
    sim.setBoolProperty(tube, 'respondable', true)
    sim.setIntProperty(tube, 'respondableMask', 0xff00) -- rollers ignore each other and meet everything else
    attach(DRIVE, motor)
end

function sysCall_init()
    local frame = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {ROLLERS * PITCH, 0.5, 0.02})
    sim.setObjectAlias(frame, 'Frame')
    sim.setObjectPosition(frame, {(ROLLERS - 1) * PITCH / 2, 0, HEIGHT - 0.1})
    for i = 0, ROLLERS - 1 do roller(frame, i * PITCH) end
    attach(FEEDER, place('Feeder', {0.1, 0, HEIGHT + RADIUS + 0.08}))
    attach(GATE, place('Gate', {(ROLLERS - 2) * PITCH, 0, HEIGHT}))
end
