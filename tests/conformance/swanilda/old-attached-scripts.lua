-- as: sandbox
-- passes: 0
-- spec: vrep-era 2.9; scripts without an object, attached to one, removed by themselves
-- topic: scripts
sim = require 'sim'

local function try(...) print((tostring(select(2, pcall(...))):gsub('^%-?%d+: ', ''))) end

local object = sim.createDummy(0.01)
local script = sim.addScript(sim.scripttype_customization)
sim.setScriptText(script, [[
sim = require 'sim'
function sysCall_init() print('init', sim.getObjectAlias(sim.getObjectHandle(sim.handle_self))) end
function sysCall_nonSimulation()
    if not removed then
        removed = true
        print('removed', sim.removeScript(sim.handle_self))
    end
end
function sysCall_cleanup() print('cleanup') end
]])
print(sim.associateScriptWithObject(script, object), sim.getScriptHandle(sim.scripttype_customization, object) == script)
print(sim.getScriptHandle('customization@dummy') == script, sim.getScriptHandle(sim.scripttype_simulation, object))
try(sim.getScriptHandle, 'dummy')
try(sim.associateScriptWithObject, sim.addScript(sim.scripttype_customization), object)
try(sim.removeScript, sim.createScript(sim.scripttype_simulation, ''))
print(sim.removeScript(sim.handle_all))
sim.initScript(script)

local n = 0
function sysCall_nonSimulation()
    n = n + 1
    if n == 3 then print('gone', sim.getScriptHandle(sim.scripttype_customization, object)) end
end
