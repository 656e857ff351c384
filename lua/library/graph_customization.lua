--[[
What the customization script of a graph does: `graph = require('graph_customization')`. While a simulation runs, each step is recorded, after
what other scripts gave the graph's streams (`sim.setGraphStreamValue`); what an earlier run recorded is forgotten when the next begins. The
graph becomes one that is handled explicitly, so that no main script records it a second time.

A script may decide itself what is recorded and when: its own `sysCall_init` calls `graph.init()`, and it calls `graph.handle(time)` as it likes.

Its dialog is a window of simUI. The plots are those of `swanilda view`, so `updateCurves`, `clearCurves` and `prepareCurves`, which draw, do nothing (spec: models 3).
]]

sim = _quietRequire 'sim' -- scripts find it as a global, as in the original
local graph = {}
_S.graph = graph

local INFO_TAG <const> = 'ABC_GRAPH_INFO'
local DEFAULT_INFO <const> = {bitCoded = 15, graphPos = 0, updateFreq = 2} -- what is shown, where and how often

-- The script is an object below the graph; in scenes from before there were such, it belongs to the graph itself.
local function owner()
    local object = sim.getObject('.')
    local isScript = sim.getObjectType(object) == sim.sceneobject_script
    object = isScript and sim.getObjectParent(object) or object
    return object ~= -1 and sim.getObjectType(object) == sim.sceneobject_graph and object or nil
end

--- Finds the graph, `graph.model`, and makes it one that is handled explicitly.
function graph.init()
    graph.model = owner()
    if graph.model and sim.getExplicitHandling(graph.model) == 0 then sim.setExplicitHandling(graph.model, 1) end
end

--- Records the values of the streams.
-- @param recordingTime seconds; the end of the present step if left out
function graph.handle(recordingTime)
    local time = recordingTime or sim.getSimulationTime() + sim.getSimulationTimeStep()
    if graph.model then sim.handleGraph(graph.model, time) end
end

--- Clears the recorded data.
function graph.reset()
    if graph.model then sim.resetGraph(graph.model) end
end

--- Settings of the display: bitCoded, graphPos, updateFreq.
function graph.readInfo()
    local packed = graph.model and sim.readCustomStringData(graph.model, INFO_TAG)
    local info = packed and #packed > 0 and sim.unpackTable(packed) or {}
    for key, value in pairs(DEFAULT_INFO) do
        if info[key] == nil then info[key] = value end
    end
    return info
end

--- Stores settings of the display with the graph.
function graph.writeInfo(info)
    if graph.model then sim.writeCustomStringData(graph.model, INFO_TAG, sim.packTable(info)) end
end

function graph.updateCurves() end

function graph.clearCurves() end

function graph.prepareCurves() end

---------------------------------------------------------------- the dialog

local SHOWN_RUNNING <const>, SHOWN_STOPPED <const>, TIME <const>, XY <const>, EQUAL_AXES <const>, NO_3D <const> = 1, 2, 4, 8, 16, 32
local PLACES <const> = {'bottom right', 'top right', 'top left', 'bottom left', 'centre'}
local OFTEN <const> = {'each time', 'every 2nd time', 'every 4th time', 'every 10th time', 'every 100th time'}

local function option(text, bit)
    return {
        kind = 'check', text = text,
        read = function() return graph.readInfo().bitCoded & bit ~= 0 end,
        write = function(isOn)
            local info = graph.readInfo()
            info.bitCoded = isOn and info.bitCoded | bit or info.bitCoded & ~bit
            graph.writeInfo(info)
        end,
    }
end

local function choice(text, items, name)
    return {
        kind = 'choice', text = text, items = items,
        read = function() return graph.readInfo()[name] end,
        write = function(value)
            local info = graph.readInfo()
            info[name] = value
            graph.writeInfo(info)
        end,
    }
end

local function openDialog()
    if graph.dialog or not graph.model then return end
    require('swanilda.settings_window').open(graph, '_S.graph', 'dialog', sim.getObjectAlias(graph.model, 1), {
        option('visible while a simulation runs', SHOWN_RUNNING), option('visible while stopped', SHOWN_STOPPED),
        option('plot over time', TIME), option('plot of x and y', XY), option('equal axes', EQUAL_AXES), option('no curves in 3D', NO_3D),
        choice('position', PLACES, 'graphPos'), choice('update', OFTEN, 'updateFreq'),
    })
end

function graph.cleanup()
    if graph.dialog then require('swanilda.settings_window').close(graph, 'dialog') end
end

---------------------------------------------------------------- callbacks

function sysCall_init() graph.init() end

function sysCall_userConfig()
    if sim.getSimulationState() == sim.simulation_stopped then openDialog() end
end

function sysCall_beforeSimulation() graph.reset() end

-- The last pass before the end is not recorded.
function sysCall_sensing()
    if sim.getSimulationState() ~= sim.simulation_advancing_lastbeforestop then graph.handle() end
end

function sysCall_cleanup() graph.cleanup() end

return graph
