-- topic: messages
-- as: sandbox
-- passes: 0
-- spec: data 1
-- note: systemCall messages of the engine
sim = require 'sim'
local SIMU, CUST = sim.scripttype_simulation, sim.scripttype_customization
local function mk(kind, alias, parent, code)
    local h = sim.createScript(kind, code, 0, 'lua')
    sim.setObjectAlias(h, alias)
    if parent then sim.setObjectParent(h, parent, true) end
    return h
end
local R = mk(CUST, 'r', nil, "sim = require 'sim' function sysCall_msg(...) local m = ... if m.id == 'systemCall' then print(m.id, m.data.callType == sim.syscb_init and 'init' or m.data.callType == sim.syscb_cleanup and 'cleanup' or m.data.callType, sim.getObjectAlias(m.data.script), select('#', ...)) end end")
sim.initScript(R)
local a = mk(CUST, 'with', nil, "function sysCall_init() end function sysCall_cleanup() end")
local b = mk(CUST, 'without', nil, "x = 1")
sim.initScript(a) sim.initScript(b)
print('again')
sim.initScript(a)
