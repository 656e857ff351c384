-- topic: old functions
-- as: sandbox
-- passes: 0
-- spec: vrep-era 2.4
sim = require 'sim'
local a, b, c = sim.createDummy(0.01), sim.createDummy(0.01), sim.createDummy(0.01)
sim.setObjectParent(b, a, true)
sim.setObjectParent(c, b, true)
local function n() return #sim.getObjectSel() end
sim.setObjectSel({})
print(sim.addObjectToSelection({a, b, 999998}), n())
print(sim.addObjectToSelection(nil), n())
print(sim.removeObjectFromSelection({a}), n())
print(sim.removeObjectFromSelection(sim.handle_all, -1), n())
print(sim.addObjectToSelection(sim.handle_tree, b), n())
print(sim.removeObjectFromSelection(sim.handle_all), n())
print(sim.addObjectToSelection(sim.handle_chain, b), n())
print(sim.addObjectToSelection(sim.handle_single, c), n())
print(sim.isObjectInSelection(c), sim.isObjectInSelection(a), sim.isObjectInSelection(999998))
print(sim.removeObjectFromSelection(nil), n())
