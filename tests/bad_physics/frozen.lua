-- A body whose motion runs out of numbers stops and is reported, once; put elsewhere, it moves again.
sim = require 'sim'
watch = require 'watch'

function sysCall_init()
    body = watch.box('victim', {0, 0, 5}, true, true)
    other = watch.box('other', {2, 0, 5}, true, true)
    steps = 0
end

function sysCall_actuation()
    steps = steps + 1
    if steps <= 4 then sim.addForceAndTorque(body, {1e308, 0, 0}, {1e308, 1e308, 0}) end
    if steps == 6 then sim.setObjectPosition(body, {0, 0, 3}) end
end

function sysCall_sensing()
    watch.check()
    if steps == 6 then print('falls again', sim.getObjectPosition(body)[3] < 3, sim.getObjectPosition(other)[3] < 4.9) end
end

function sysCall_afterSimulation() print('all is well') end
