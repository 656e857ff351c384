-- topic: callbacks
-- as: sandbox
-- passes: 0
-- loops: 6
-- spec: callbacks 4, objects 4, objects 5
-- note: who is told of objects that come and go, in which order, with what
sim = require 'sim'
local watcher = [[
sim = require 'sim'
local function keys(t) local r = {} for k in pairs(t) do r[#r + 1] = tostring(k) end table.sort(r) return table.concat(r, ' ') end
local function told(call) return function(d)
    local marked = 0
    for k, v in pairs(d.objectHandles) do if v == true then marked = marked + 1 end end
    print(NAME, call, keys(d), #d.objects, marked, d.allObjects)
end end
sysCall_beforeCopy, sysCall_afterCopy, sysCall_afterCreate = told 'beforeCopy', told 'afterCopy', told 'afterCreate'
sysCall_beforeDelete, sysCall_afterDelete = told 'beforeDelete', told 'afterDelete'
function sysCall_cleanup() if NAME ~= 'last' then print(NAME, 'cleanup') end end
]]
local function script(kind, name, priority)
    local h = sim.createScript(kind, 'NAME = "' .. name .. '"\n' .. watcher, 0, 'lua')
    sim.setObjectAlias(h, name)
    sim.setIntProperty(h, 'execPriority', priority)
    return h
end
local last = script(sim.scripttype_customization, 'last', sim.scriptexecorder_last)
local first = script(sim.scripttype_customization, 'first', sim.scriptexecorder_first)
script(sim.scripttype_simulation, 'asleep', sim.scriptexecorder_normal)
sim.initScript(last) sim.initScript(first)
local base = sim.createDummy(0.01)
local child = sim.createDummy(0.01)
sim.setObjectParent(child, base, true)
sim.setModelProperty(base, 0)
print('-- copy of a model: the listed base stands for all of it')
local copies = sim.copyPasteObjects({base, child}, 1)
print(#copies, copies[2] ~= -1, sim.getObjectAlias(sim.getObjectChild(copies[1], 0)))
print('-- nothing to copy, nobody told')
print(sim.copyPasteObjects({child}, 1))
print('-- removal of a model')
print(sim.removeModel(copies[1]))
print('-- a script is cleaned up before anybody is told that it goes')
sim.removeObjects({base, first})
