sim = require 'sim'

function sysCall_init()
    count = 1
end

function sysCall_actuation()
    sim.setIntProperty(sim.handle_scene, 'signal.count', count)
end
