-- A ball that falls, a message, and an error; for `view_capture.py`.
sim = require 'sim'

function sysCall_init()
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2})
    sim.setObjectAlias(ball, 'ball')
    sim.setFloatProperty(ball, 'customData.speed', 1)
    print('ready')
end

function sysCall_actuation()
    local time = sim.getSimulationTime()
    sim.setObjectPosition(ball, {sim.getFloatProperty(ball, 'customData.speed') * time, 0, 1})
    print(('step at %.2f'):format(time))
    if math.abs(time - 0.5) < 1e-6 then sim.broadcastMsg {id = 'half'} end
    if math.abs(time - 1) < 1e-6 then error 'too far' end
end
