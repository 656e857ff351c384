-- topic: old functions
-- as: sandbox
-- passes: 0
-- spec: vrep-era 2.5
sim = require 'sim'
local d = sim.createDummy(0.01)
print(sim.getObjectSizeFactor(d), sim.getObjectSizeValues(d))
print(sim.setObjectSizeValues(d, {2, 3, 4}), sim.getObjectSizeValues(d))
sim.scaleObjects({d}, 2, false)
print(sim.getObjectSizeFactor(d), sim.getObjectSizeValues(d))
print((tostring(select(2, pcall(sim.getObjectSizeValues, 999998))):gsub('^%-?%d+: ', '')))
