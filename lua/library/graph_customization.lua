--[[
What the customization script of a graph does: `require('graph_customization')`. While a simulation runs, each step is recorded, after what
other scripts gave the graph's streams (`sim.setGraphStreamValue`); what an earlier run recorded is forgotten when the next begins. Graphs
that are handled explicitly are left alone.

Opens no dialog and draws nothing: there is no display.
]]

local sim = package.loaded.sim or require 'sim'
local graph = {}

-- The script is an object below the graph; in scenes from before there were such, it belongs to the graph itself.
local function owner()
    local object = sim.getObject('.')
    local isScript = sim.getObjectType(object) == sim.sceneobject_script
    object = isScript and sim.getObjectParent(object) or object
    local records = object ~= -1 and sim.getObjectType(object) == sim.sceneobject_graph
    return records and sim.getExplicitHandling(object) == 0 and object or nil
end

function sysCall_beforeSimulation()
    local object = owner()
    if object then sim.resetGraph(object) end
end

function sysCall_sensing()
    local object = owner()
    if object then sim.handleGraph(object, sim.getSimulationTime() + sim.getSimulationTimeStep()) end
end

return graph
