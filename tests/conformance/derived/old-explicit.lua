-- topic: old functions
-- as: sandbox
-- passes: 0
-- spec: vrep-era 2.9
sim = require 'sim'
local function try(...)
    local ok, e = pcall(...)
    print(ok, (tostring(e):gsub('^%-?%d+: ', '')))
end
local j = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0, {0.1, 0.02})
local p = sim.createPath(0)
print(sim.setExplicitHandling(j, 1), sim.setExplicitHandling(p, 1), sim.setExplicitHandling(p, 0))
try(sim.setExplicitHandling, sim.createDummy(0.01), 1)
try(sim.setExplicitHandling, -1, 1)
try(sim.setExplicitHandling, 999998, 1)
try(sim.readCollision, 2010001)
try(sim.handleDistance, 2020002)
try(sim.handleIkGroup, 2030003)
try(sim.removeScript, sim.handle_self)
