-- topic: scripts
-- as: customization
-- passes: 0
-- note: old scripts count their own runs
sim = require 'sim'
print(sim.getScriptExecutionCount())
sim.setScriptAttribute(sim.handle_self, sim.scriptattribute_executioncount, 3)
print(sim.getScriptExecutionCount(), sim.getScriptAttribute(sim.handle_self, sim.scriptattribute_executioncount))
