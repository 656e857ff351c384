-- A tower of boxes that is not quite straight, dropped onto the floor.
--
--     swanilda run scenes/falling_boxes.lua

sim = require 'sim'

local SIDE = 0.1 -- metres
local COUNT = 8

local function box(i)
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {SIDE, SIDE, SIDE})
    sim.setObjectAlias(h, 'Box')
    sim.setObjectPosition(h, {0.03 * math.sin(i), 0.03 * math.cos(i), 0.2 + 1.2 * SIDE * i})
    sim.setBoolProperty(h, 'dynamic', true) -- it falls ...
    sim.setBoolProperty(h, 'respondable', true) -- ... and things stop it
    return h
end

function sysCall_init()
    boxes = {}
    for i = 1, COUNT do boxes[i] = box(i) end
end

local function highest()
    local top = 0
    for _, h in ipairs(boxes) do top = math.max(top, sim.getObjectPosition(h)[3] + SIDE / 2) end
    return top
end

function sysCall_sensing()
    local t = sim.getSimulationTime()
    if (t + 1e-6) % 0.5 < 2e-6 then
        print(string.format('t = %.1f s   the highest box reaches %.3f m', t, highest()))
    end
    if t >= 3 and not done then
        done = true
        local still = 0
        for _, h in ipairs(boxes) do
            local v = sim.getVelocity(h)
            if math.sqrt(v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2) < 0.01 then still = still + 1 end
        end
        print(string.format('%d of %d boxes lie still.', still, COUNT))
        sim.stopSimulation()
    end
end
