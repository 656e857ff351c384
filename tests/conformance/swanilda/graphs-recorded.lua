-- topic: graphs
-- as: customization
-- passes: 0
-- loops: 40
-- spec: sensors 7
-- note: the customization script of a graph records each step, also of a graph that is handled explicitly, unless it has a loop of its own
sim = require 'sim'
local xml = [[<CoppeliaSim><filetype>simpleModel</filetype><xmlSerializationNb>2</xmlSerializationNb>
<graph><common><alias>graph</alias></common></graph></CoppeliaSim>]]
local graph = sim.loadModel(sim.packUInt8Table({xml:byte(1, -1)}))
local recorder = sim.createScript(sim.scripttype_customization, "require('graph_customization')")
sim.setObjectParent(recorder, graph)
sim.setExplicitHandling(graph, 1) -- as scenes of the original have it
sim.initScript(recorder)
local own = sim.loadModel(sim.packUInt8Table({xml:byte(1, -1)}))
local loop = sim.createScript(sim.scripttype_customization, [[
graph = require('models.graph_customization-2')
function sysCall_init()
    graph.init()
    print(graph.model == sim.getObjectParent(sim.getObject('.')), sim.getExplicitHandling(graph.model), graph.readInfo())
    graph.writeInfo({updateFreq = 0})
    print(graph.readInfo())
end
function sysCall_sensing() if sim.getSimulationTime() == 0 then graph.handle(7) end end
]])
sim.setObjectParent(loop, own)
sim.initScript(loop)
local ownStream = sim.addGraphStream(own, 'own', '', 0, {1, 0, 0}, 0)
local stream = sim.addGraphStream(graph, 'time', 's', 0, {1, 0, 0}, 0)
local steps = 0
function sysCall_actuation()
    steps = steps + 1
    sim.setGraphStreamValue(graph, stream, steps)
    sim.setGraphStreamValue(own, ownStream, -steps)
end
function sysCall_afterSimulation()
    local _, _, _, times, values = sim.getGraphCurve(graph, 0, 0)
    print(#times == steps - 1, times[1], values[1], values[#values] == steps - 1) -- all but the last pass
    _, _, _, times, values = sim.getGraphCurve(own, 0, 0)
    print(times, values)
end
sim.startSimulation()
function sysCall_sensing()
    if steps == 4 then sim.stopSimulation() end
end
