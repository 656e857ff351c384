-- topic: callbacks
-- as: sandbox
-- passes: 0
-- loops: 9
-- spec: callbacks 2, callbacks 4, objects 9
sim = require 'sim'
local a, b = sim.createDummy(0.01), sim.createDummy(0.01)
local code = string.format([[
sim = require 'sim'
A, B, n = %d, %d, 0
local function names(t) local r = {} for i, h in ipairs(t) do r[i] = h == A and 'a' or h == B and 'b' or '?' end return table.concat(r, ' ') end
function sysCall_selChange(d) print(NAME .. ' [' .. names(d.sel) .. ']') end
function sysCall_nonSimulation()
    if NAME ~= 'first' then return end
    n = n + 1
    if n == 2 then sim.setBoolProperty(B, 'selected', true) end
    if n == 3 then sim.setIntArrayProperty(sim.handle_scene, 'selectionHandles', {B, A}) end
    if n == 4 then sim.setBoolProperty(A, 'selected', true) end
    if n == 5 then print(sim.getBoolProperty(A, 'selected'), sim.getBoolProperty(B, 'selected')) sim.setBoolProperty(B, 'selected', false) end
    if n == 6 then sim.removeObjects({A}) end
end
]], a, b)
for _, name in ipairs {'first', 'second'} do
    local h = sim.createScript(sim.scripttype_customization, 'NAME = "' .. name .. '"\n' .. code, 0, 'lua')
    sim.setObjectAlias(h, name)
end
