-- topic: console
-- as: sandbox
-- passes: 0
-- spec: scripts 8
sim = require 'sim'
local SIMU, CUST = sim.scripttype_simulation, sim.scripttype_customization
local function mk(kind, alias, parent, code)
    local h = sim.createScript(kind, code, 0, 'lua')
    sim.setObjectAlias(h, alias)
    if parent then sim.setObjectParent(h, parent, true) end
    return h
end
local c = mk(CUST, 'logger', nil, [[
sim = require 'sim'
function sysCall_init()
    sim.addLog(sim.verbosity_errors, 'an error')
    sim.addLog(sim.verbosity_warnings, 'a warning')
    sim.addLog(sim.verbosity_scripterrors, 'a script error')
    sim.addLog(sim.verbosity_scriptwarnings, 'a script warning')
    sim.addLog(sim.verbosity_scriptinfos, 'a script info')
    sim.addLog(sim.verbosity_msgs, 'a msg')
    sim.addLog(sim.verbosity_debug, 'hidden debug')
    sim.addLog(sim.verbosity_scriptinfos | sim.verbosity_undecorated, 'undecorated')
    sim.addLog(sim.verbosity_scriptwarnings, '<b>html</b> text@html')
    sim.addLog(sim.verbosity_scripterrors | sim.verbosity_once, 'only once')
    sim.addLog(sim.verbosity_scripterrors | sim.verbosity_once, 'only once')
    addLog(sim.verbosity_scriptwarnings, 'global addLog')
    sim.addLog(sim.verbosity_scriptwarnings, 'two\nlines')
end
]])
sim.initScript(c)
print(sim.verbosity_errors, sim.verbosity_warnings, sim.verbosity_scripterrors, sim.verbosity_scriptwarnings, sim.verbosity_scriptinfos, sim.verbosity_msgs, sim.verbosity_infos, sim.verbosity_debug)
