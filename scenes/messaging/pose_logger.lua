-- A logger that knows no object by name: it listens to the stream of events and writes down where everything that moves is.
--
--     swanilda run scenes/messaging/pose_logger.lua --time 2 > poses.csv
--     swanilda run scenes/messaging/pose_logger.lua --time 2 -D csv=poses.csv

sim = require 'sim'
cbor = require 'org.conman.cbor'

local path = sim.getNamedStringParam('csv') -- nil: standard output
local file = path and assert(io.open(path, 'w'))
local lines = 0

local function write(...)
    local line = table.concat({...}, ',')
    if file then file:write(line, '\n') else print(line) end
    lines = lines + 1
end

-- A world in which things move: two falling boxes, and a dummy that is led around in a circle by its child script.
local function fallingBox(height)
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(box, {0.3 * height, 0, height})
    sim.setBoolProperty(box, 'dynamic', true)
    sim.setBoolProperty(box, 'respondable', true)
    sim.setObjectAlias(box, 'box')
end

fallingBox(1)
fallingBox(2)

local led = sim.createDummy(0.05)
sim.setObjectAlias(led, 'led')
local child = sim.createScript(sim.scripttype_simulation, [[
sim = require 'sim'

function sysCall_actuation()
    local angle = sim.getSimulationTime()
    sim.setObjectPosition(sim.getObject('..'), {math.cos(angle), math.sin(angle), 0.5})
end
]])
sim.setObjectParent(child, led, false)

function sysCall_init()
    -- Only poses, of whatever object. The rest is not even looked at.
    sim.setEventFilters({[sim.handle_sceneobject] = {'pose'}})
end

function sysCall_beforeSimulation() write('time', 'object', 'x', 'y', 'z', 'qx', 'qy', 'qz', 'qw') end

function sysCall_event(batch)
    local time = string.format('%.3f', sim.getSimulationTime())
    for _, event in ipairs(cbor.decode(tostring(batch))) do
        if event.event == 'objectChanged' then
            local pose = {}
            for i, number in ipairs(event.data.pose) do pose[i] = string.format('%.4f', number) end
            write(time, sim.getObjectAlias(event.handle, 1), table.unpack(pose))
        end
    end
end

function sysCall_afterSimulation()
    if file then file:flush() end
    sim.addLog(sim.verbosity_scriptinfos, string.format('%d lines in %s', lines, path or 'standard output'))
end
