-- topic: kinematics
-- as: sandbox
-- passes: 0
-- spec: kinematics 5
-- note: overlays of an environment that does not exist end, with an error or, where error reports are off, without.
local sim = require 'sim'
local simIK = require 'simIK'
sim.setInt32Param(sim.intparam_error_report_mode, 0)
print(pcall(simIK.debugGroupIfNeeded, 99, 1, 1))
print((pcall(simIK.createDebugOverlay, 99, 1, -1)))
