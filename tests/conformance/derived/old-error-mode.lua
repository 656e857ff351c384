-- topic: old names
-- as: sandbox
-- passes: 0
-- spec: vrep-era 2.2
sim = require 'sim'
local P = sim.intparam_error_report_mode
print(sim.getInt32Param(P))
print(sim.setInt32Param(P, 0), sim.getInt32Param(P))
print(sim.setExplicitHandling(-1, 1), sim.getLastError(), '[' .. sim.getLastError() .. ']')
print(select('#', sim.getObjectPosition(999998)))
print(sim.setInt32Param(P, 1), sim.getInt32Param(P))
print(pcall(sim.setExplicitHandling, -1, 1) == false)
