-- topic: custom data
-- as: sandbox
-- passes: 0
-- spec: data 4
sim = require 'sim'
local d = sim.createDummy(0.01)
print(sim.readCustomStringData(d, 'x'), select('#', sim.readCustomStringData(d, 'x')))
print(sim.readCustomBufferData(d, 'x'), sim.readCustomTableData(d, 'x'), sim.readCustomDataTags(d))
sim.writeCustomStringData(d, 'x', 'abc\0d')
sim.writeCustomBufferData(d, 'y', tobuffer('buf'))
sim.writeCustomTableData(d, 'z', {1, 'two', k = {true}})
print(#sim.readCustomStringData(d, 'x'), sim.readCustomBufferData(d, 'x'), isbuffer(sim.readCustomBufferData(d, 'y')), sim.readCustomStringData(d, 'y'))
print(sim.readCustomTableData(d, 'z'))
local t = sim.readCustomDataTags(d) table.sort(t) print(t)
sim.writeCustomStringData(d, 'x', '')
print(sim.readCustomStringData(d, 'x'))
sim.writeCustomTableData(d, 'z', {})
print(sim.readCustomTableData(d, 'z'))
t = sim.readCustomDataTags(d) table.sort(t) print(t)
sim.writeCustomStringData(d, '', '')
print(sim.readCustomDataTags(d))
print(pcall(sim.readCustomStringData, 999998, 'x'))
