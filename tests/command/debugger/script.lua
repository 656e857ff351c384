local sim = require 'sim'
local count = 0
local items = {1, 2, 3, name = 'x', inner = {a = 1}}

local function add(n)
    local before = count
    count = count + n
    return before
end

function sysCall_init()
    for i = 1, 3 do
        add(i)
    end
end

function sysCall_thread()
    while not sim.getSimulationStopping() do
        local t = sim.getSimulationTime()
        sim.step()
        local later = t + 1
    end
end

function sysCall_actuation()
    local was = add(10)
    local last = was
end
