-- topic: old names
-- as: sandbox
-- passes: 0
-- spec: vrep-era 1.1
sim = require 'sim'
local a, b, c = sim.createDummy(0.01), sim.createDummy(0.01), sim.createDummy(0.01)
print(sim.setObjectName(a, 'motor'), sim.setObjectName(b, 'motor#0'), sim.setObjectName(c, 'motor#7'))
local function who(n)
    local h = sim.getObjectHandle(n, {noError = true})
    return h == a and 'a' or h == b and 'b' or h == c and 'c' or h
end
print(who('motor'))
print(who('motor#0'), who('motor#'), who('motor#7'), who('motor#8'))
print(sim.getNameSuffix(nil))
print(sim.setNameSuffix(7), sim.getNameSuffix(nil))
print(who('motor'), who('motor#'), who('motor#0'))
print(sim.setNameSuffix(3), who('motor'))
sim.setNameSuffix(-1)
print(sim.getNameSuffix('arm#12'))
print(sim.getNameSuffix('arm12'))
print(sim.getNameSuffix('arm#'))
print(sim.getObjectName(b), sim.getObjectAlias(b))
