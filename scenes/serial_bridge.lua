--[[
A bridge between a serial device and the simulation: lines that a device sends set the speed of a motor, and the angle of the motor
is sent back. The device is an Arduino, or anything else that reads and writes lines:

    speed 1.5        sets the speed, rad/s
    stop             ends the simulation
    angle 0.750      sent to the device ten times a second

    swanilda run scenes/serial_bridge.lua --realtime -D port=/dev/ttyUSB0 -D baud=115200

Without a device, two pseudo-terminals do:

    socat pty,raw,echo=0,link=/tmp/robot pty,raw,echo=0,link=/tmp/me &
    swanilda run scenes/serial_bridge.lua --realtime -D port=/tmp/robot &
    cat /tmp/me & echo 'speed 1.5' > /tmp/me
]]

sim = require 'sim'

local motor, port

function sysCall_init()
    motor = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
    sim.setObjectAlias(motor, 'motor')
    sim.setJointInterval(motor, true, {0, 0})
end

local commands = {}

function commands.speed(value) sim.setJointTargetVelocity(motor, tonumber(value) or 0) end

function commands.stop() sim.stopSimulation() end

local function open()
    local path = sim.getNamedStringParam('port') or '/dev/ttyUSB0'
    local handle = sim.serialOpen(path, tonumber(sim.getNamedStringParam('baud') or 115200))
    if handle > 0 then return handle end
    sim.addLog(sim.verbosity_scripterrors, 'cannot open ' .. path .. '; choose another with -D port=PATH')
    sim.stopSimulation()
    while not sim.getSimulationStopping() do sim.step() end
end

-- The thread waits for lines while the simulation goes on. A port is closed when the simulation ends, so that each run opens it anew.
function sysCall_thread()
    while true do
        if not sim.getSimulationStopping() then
            port = open()
            while port and not sim.getSimulationStopping() do
                local line = sim.serialRead(port, 80, true, '\n', 0.5)
                local command, value = line:match('^(%a+)%s*(%S*)%s*$')
                if commands[command] then commands[command](value) end
            end
        end
        port = nil
        sim.step()
    end
end

local lastSent

function sysCall_sensing()
    local t = sim.getSimulationTime()
    if not port or lastSent and t >= lastSent and t - lastSent < 0.099 then return end
    lastSent = t
    sim.serialSend(port, ('angle %.3f\n'):format(sim.getJointPosition(motor)))
end

function sysCall_afterSimulation() port = nil end
