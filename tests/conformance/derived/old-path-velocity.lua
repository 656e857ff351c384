-- topic: old paths
-- as: customization
-- passes: 3
-- spec: vrep-era 3
-- note: attributes 0x20: infinite acceleration
sim = require 'sim'
function sysCall_init()
    path = sim.createPath(0x20)
    sim.insertPathCtrlPoints(path, 0, 0, 2, {0, 0, 0, 0, 0, 0, 1, 0, 1, 0.5, 0.5, 1, 0, 0, 0, 0, 0, 1, 0, 1, 0.5, 0.5})
    print(sim.setPathTargetNominalVelocity(path, 0.5))
end
function sysCall_actuation() print('a', string.format('%.3f', sim.getPathPosition(path))) end
function sysCall_sensing() print('s', string.format('%.3f', sim.getPathPosition(path))) end
