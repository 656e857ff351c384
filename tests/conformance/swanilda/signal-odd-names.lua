-- topic: signals
-- as: sandbox
-- passes: 0
-- spec: data 2
-- note: names of the older functions are texts without spaces; properties have letters, digits, underscores and dots
sim = require 'sim'
for _, name in ipairs {'/blueArm_executedMovId', 'a-b', 'x:1', 'ä', 'two words', 'tab\tbed', ''} do
    print(('%q'):format(name), sim.setStringSignal(name, 'ready'), sim.getStringSignal(name), sim.clearStringSignal(name), sim.getStringSignal(name))
end
sim.setInt32Signal('/n', 3)
print(sim.getSignalName(0, 0), sim.getInt32Signal('/n'), sim.getStringSignal('/n'))
print((pcall(sim.setStringProperty, sim.handle_scene, 'signal.a-b', 'x')))
