sim = require 'sim'

local function add(a, b)
    local sum = a + b
    return sum
end

function sysCall_init()
    total, robot = 0, {name = 'bee', legs = {'left', 'right'}}
end

function sysCall_actuation()
    local step = total + 1

    total = add(total, 1)
    sim.setIntProperty(sim.handle_scene, 'signal.total', total)
    print('total ' .. total)
end
