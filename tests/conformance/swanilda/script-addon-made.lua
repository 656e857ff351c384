-- topic: scripts
-- as: sandbox
-- passes: 0
-- spec: calls 2
-- note: an add-on that a script makes is disabled, and begins with sim.initScript
sim = require 'sim'

local code = [[
sim = require 'sim'
local passes = 0
function sysCall_init() print('init') value = 7 end
function sysCall_nonSimulation() passes = passes + 1 if passes == 1 then print('pass') end end
function sysCall_cleanup() print('cleanup', value) end
function double(x) return 2 * x + value end
]]
local addOn = sim.createScript(sim.scripttype_addon, code)
print('made', sim.getBoolProperty(addOn, 'scriptDisabled'), (pcall(sim.callScriptFunction, 'double', addOn, 4)))
sim.initScript(addOn)
print('ready', sim.getBoolProperty(addOn, 'scriptDisabled'), sim.callScriptFunction('double', addOn, 4))
sim.initScript(addOn)
