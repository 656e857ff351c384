-- as: simulation
-- passes: 6
-- spec: dynamics 4; what a callback changes counts from the next pair of the same sub-step on
-- topic: dynamics
sim = require 'sim'

local function box(x, z, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setBoolProperty(shape, 'dynamic', dynamic)
    sim.setBoolProperty(shape, 'respondable', true)
    sim.setIntProperty(shape, 'respondableMask', 0xffff)
end

for i = 1, 5 do
    box(i, 0, false)
    box(i, 0.099, true)
end

local function script(code)
    local handle = sim.createScript(sim.scripttype_simulation, code, 0, 'lua')
    sim.initScript(handle)
    return handle
end

-- Counts its calls, and does something at the second one.
local asked = [[
sim = require 'sim'
calls, others = 0, 0
function count() return calls, other and sim.callScriptFunction('count', other) or others end
function sysCall_contact()
    calls = calls + 1
    if calls == 2 then second() end
end
]]

local cases = {
    {'nothing', ''},
    {'assigns another function', 'sysCall_contact = function() others = others + 1 end'},
    {'removes its function', 'sysCall_contact = nil'},
    {'disables itself', "sim.setBoolProperty(sim.getScript(sim.handle_self), 'scriptDisabled', true)"},
    {'adds a hook', "hook = function() others = others + 1 end sim.registerScriptFuncHook('sysCall_contact', 'hook', true)"},
    {'adds a script', [[
        other = sim.createScript(sim.scripttype_simulation, "calls = 0 function count() return calls end function sysCall_contact() calls = calls + 1 end", 0, 'lua')
        sim.initScript(other)]]},
}

local step, handle = 0, nil
function sysCall_actuation()
    step = step + 1
    if not cases[step] then return end
    handle = script(asked .. 'function second() ' .. cases[step][2] .. ' end')
end

function sysCall_sensing()
    if not cases[step] then return end
    local calls, others = sim.callScriptFunction('count', handle)
    local all = math.max(calls, others + 2)
    local function words(count) return count < 3 and count or count == all and 'all' or count == all - 2 and 'all but two' or count end
    print(('%s: is asked %s times, the other %s'):format(cases[step][1], words(calls), words(others)))
    sim.removeObjects({handle})
end
