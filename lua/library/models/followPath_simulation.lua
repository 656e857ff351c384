--[[
Simulation script that moves the joints of a group along a path, as fast as limits allow, and then goes away: `require 'models.followPath_simulation'`. Its referenced
handle `path` is the path, whose table data `path` are the states and whose referenced handle `jointGroup` is the group (spec: models 6).

Globals of the script: fkMaxVel (1), fkMaxAccel (5): limits of each joint.
]]

local sim = _quietRequire 'sim'

local SAMPLES <const>, SPEED <const>, ACCELERATION <const> = 1000, 1, 5
local states, joints

local function referenced(object, tag)
    local handle = sim.getReferencedHandles(object, tag)[1]
    if not handle or not sim.isHandle(handle) then error(('the referenced handle %s is missing'):format(tag), 0) end
    return handle
end

function sysCall_init()
    local path = referenced(sim.getObject('.'), 'path')
    states = sim.readCustomTableData(path, 'path')
    joints = sim.getReferencedHandles(referenced(path, 'jointGroup'))
    if #states < 2 or #states[1] ~= #joints then error(('a path of states with %d values is needed'):format(#joints), 0) end
end

-- Minima and maxima, as sim.generateTimeOptimalTrajectory wants them.
local function limits(value, default)
    local list = {}
    for i = 1, #joints do
        local most = type(value) == 'table' and value[i] or tonumber(value) or default
        list[2 * i - 1], list[2 * i] = -most, most
    end
    return list
end

function setTargetConfig(config)
    for i, joint in ipairs(joints) do
        if sim.isDynamicallyEnabled(joint) then
            sim.setJointTargetPosition(joint, config[i])
        else
            sim.setJointPosition(joint, config[i])
        end
    end
end

local function distance(a, b)
    local sum = 0
    for i = 1, #a do sum = sum + (b[i] - a[i]) ^ 2 end
    return math.sqrt(sum)
end

function sysCall_thread()
    local flat, count = {}, #joints
    for i, state in ipairs(states) do table.move(state, 1, count, (i - 1) * count + 1, flat) end
    local lengths = sim.getPathLengths(flat, count, distance)
    local path, times = sim.generateTimeOptimalTrajectory(
        flat, lengths, limits(fkMaxVel, SPEED), limits(fkMaxAccel, ACCELERATION), SAMPLES, 'not-a-knot')
    local start, last = sim.getSimulationTime(), times[#times]
    while sim.getSimulationTime() - start < last do
        setTargetConfig(sim.getPathInterpolatedConfig(path, times, sim.getSimulationTime() - start))
        sim.step()
    end
    setTargetConfig(states[#states])
    sim.removeObjects({sim.getObject('.')}, true)
end
