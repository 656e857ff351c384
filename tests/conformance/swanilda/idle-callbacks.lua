-- topic: callbacks
-- as: simulation
-- passes: 8
-- spec: callbacks 1; callbacks that are empty or missing, until other code makes them do something
sim = require 'sim'
local step = 0

local function child(text) return sim.createScript(sim.scripttype_customization, text, 0, 'lua') end

function sysCall_init()
    sim.setIntProperty(sim.handle_app, 'consoleVerbosity', sim.verbosity_scripterrors)
    late = child('function sysCall_init() end')
    empty = child('function sysCall_init() end function sysCall_actuation() end function sysCall_sensing() end')
    hooked = child('function sysCall_init() end function hook() print("hook") end function sysCall_sensing() end')
    handled = child('function sysCall_init() end function sysCall_actuation() end count = 0')
end

function sysCall_actuation()
    step = step + 1
    if step == 1 then hookWhileRunning() end
    if step == 3 then sim.executeScriptString('function sysCall_actuation() print("late") end', late) end
    if step == 4 then sim.executeScriptString('function sysCall_sensing() print("no longer empty") end', empty) end
    if step == 5 then
        sim.executeScriptString('sim = require "sim" sim.registerScriptFuncHook("sysCall_sensing", "hook", false)', hooked)
    end
    if step == 6 then sim.executeScriptString('function sysCall_actuation() count = count + 1 end', handled) end
    if step == 7 then sim.executeScriptString('sysCall_actuation = nil', late) end
end

function sysCall_sensing()
    -- They are there from the second step on.
    if step > 1 then print(step, sim.executeScriptString('return count', handled)) end
end

function created() print('created') end

--- A callback that does nothing, until the code that runs adds a hook for it.
function hookWhileRunning()
    sim.createDummy(0.01)
    sim.registerScriptFuncHook('sysCall_afterCreate', 'created', false)
    sim.createDummy(0.01)
end
