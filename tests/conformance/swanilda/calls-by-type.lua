-- topic: calls
-- as: sandbox
-- passes: 0
-- spec: calls 1
-- note: scenes from before 4.8 call scripts by type and object; their conversion puts this function in
sim = require 'sim'
local function e(f, ...) local ok, m = pcall(f, ...) print(ok, ok and tostring(m) or (m:gsub('^.-: ', ''))) end
local robot = sim.createDummy(0.1)
sim.setObjectAlias(robot, 'robot')
local function script(kind, code)
    local made = sim.createScript(kind, code)
    sim.setObjectParent(made, robot)
    sim.initScript(made)
    return made
end
local own = script(sim.scripttype_customization, "function twice(x) return 2 * x end t = {f = function(x) return x .. '!' end}")
script(sim.scripttype_simulation, 'function thrice(x) return 3 * x end')

print(sim._callScriptFunction('twice@/robot', sim.scripttype_customization, 4))
print(sim._callScriptFunction('twice@robot', sim.scripttype_customization, 4))
print(sim._callScriptFunction('t.f@/robot', sim.scripttype_customization, 'dotted'))
print(sim._callScriptFunction('twice', own, 6))
-- the wrong type, nobody, no function
e(sim._callScriptFunction, 'twice@/robot', sim.scripttype_simulation, 4)
e(sim._callScriptFunction, 'twice@/nobody', sim.scripttype_customization, 4)
e(sim._callScriptFunction, 'missing@/robot', sim.scripttype_customization, 4)
-- one script of these there is
function here(x) return 'sandbox ' .. x end
print(sim._callScriptFunction('here@', sim.scripttype_sandbox, 1))
print(sim._callScriptFunction('here', sim.scripttype_sandbox, 2))
e(sim._callScriptFunction, 'here', 12345, 2)
