-- topic: graphs
-- as: customization
-- passes: 0
-- loops: 40
-- spec: sensors 7
-- note: the customization script of a graph records each step
sim = require 'sim'
local xml = [[<CoppeliaSim><filetype>simpleModel</filetype><xmlSerializationNb>2</xmlSerializationNb>
<graph><common><alias>graph</alias></common></graph></CoppeliaSim>]]
local graph = sim.loadModel(sim.packUInt8Table({xml:byte(1, -1)}))
local recorder = sim.createScript(sim.scripttype_customization, "require('graph_customization')")
sim.setObjectParent(recorder, graph)
sim.initScript(recorder)
local stream = sim.addGraphStream(graph, 'time', 's', 0, {1, 0, 0}, 0)
local steps = 0
function sysCall_actuation()
    steps = steps + 1
    sim.setGraphStreamValue(graph, stream, steps)
end
function sysCall_afterSimulation()
    local _, _, _, times, values = sim.getGraphCurve(graph, 0, 0)
    print(#times == steps, times[1], values[1], values[#values] == steps)
end
sim.startSimulation()
function sysCall_sensing()
    if steps == 4 then sim.stopSimulation() end
end
