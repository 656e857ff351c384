-- topic: graphs
-- as: sandbox
-- passes: 0
-- spec: sensors 7
sim = require 'sim'
local function fails(...)
    return (select(2, pcall(...)):gsub('^%-?%d+: ', ''))
end
local function numbers(list)
    local out = {}
    for i, number in ipairs(list) do out[i] = string.format('%.3f', number) end
    return '{' .. table.concat(out, ' ') .. '}'
end
local xml = [[<CoppeliaSim><filetype>simpleModel</filetype><xmlSerializationNb>2</xmlSerializationNb>
<graph><common><alias>graph</alias><switches><modelBase>true</modelBase></switches></common><bufferSize>4</bufferSize></graph></CoppeliaSim>]]
local graph = sim.loadModel(sim.packUInt8Table({xml:byte(1, -1)}))
print(sim.getObjectType(graph) == sim.sceneobject_graph)
local streams = {}
for i, kind in ipairs({'raw', 'derivative', 'integral', 'cumulative'}) do
    streams[i] = sim.addGraphStream(graph, kind, 'm', 0, {1, 0, 0}, 0)
    sim.setGraphStreamTransformation(graph, streams[i], sim['stream_transf_' .. kind])
end
local hidden = sim.addGraphStream(graph, 'hidden', '', 1 + 2)
print(sim.addGraphStream(graph, 'raw', 'mm', 4, {0, 1, 0}, 0) == streams[1])
for slot, value in ipairs({0, 1, 3}) do
    for _, stream in ipairs(streams) do sim.setGraphStreamValue(graph, stream, value) end
    sim.handleGraph(graph, 0.05 * slot)
end
local function show(kind)
    local index = 0
    while true do
        local curve = table.pack(sim.getGraphCurve(graph, kind, index))
        if not curve[1] then break end
        for i = 1, curve.n do
            if type(curve[i]) == 'table' then curve[i] = numbers(curve[i]) end
        end
        print(table.unpack(curve, 1, curve.n))
        index = index + 1
    end
end
show(0)
-- two more slots: a gap, and the oldest goes
sim.handleGraph(sim.handle_all, 0.2)
sim.setGraphStreamValue(graph, streams[1], 5)
sim.setGraphStreamTransformation(graph, streams[1], sim.stream_transf_raw, 2, 1, 2)
sim.handleGraph(sim.handle_all_except_explicit, 0.25)
print(numbers((select(4, sim.getGraphCurve(graph, 0, 0)))), numbers((select(5, sim.getGraphCurve(graph, 0, 0)))))
-- curves of streams and numbers
local xy = sim.addGraphCurve(graph, 'xy', 2, {streams[4], -1}, {0, 7}, 'm')
local xyz = sim.addGraphCurve(graph, 'xyz', 3, {streams[3], -1, streams[4]}, {0, 7, 0}, 'm', 4, {0, 0, 1}, 3)
show(1)
show(2)
-- what recording does not change
local static = sim.duplicateGraphCurveToStatic(graph, xy, 'kept')
sim.resetGraph(graph)
show(1)
print(fails(sim.addGraphCurve, graph, 'kept', 2, {streams[1], -1}, {0, 0}, ''))
sim.destroyGraphCurve(graph, static)
print(fails(sim.destroyGraphCurve, graph, static))
print(fails(sim.setGraphStreamValue, graph, 99, 0))
print(fails(sim.addGraphStream, graph, '', ''))
print(fails(sim.addGraphCurve, graph, 'c', 4, {0, 1}, {0, 0}, ''))
print(fails(sim.addGraphCurve, graph, 'c', 3, {0, 1}, {0, 0, 0}, ''))
print(fails(sim.addGraphCurve, graph, 'c', 2, {0, 99}, {0, 0}, ''))
-- files keep all of it
for _, stream in ipairs({1, 3, 4}) do sim.setGraphStreamValue(graph, streams[stream], 4) end
sim.setGraphStreamTransformation(graph, streams[1], sim.stream_transf_raw)
sim.handleGraph(graph, 1)
local again = sim.loadModel(sim.saveModel(graph))
for _, handle in ipairs({graph, again}) do
    print(sim.getGraphCurve(handle, 0, 0))
    print(sim.getGraphCurve(handle, 2, 0))
end
print(sim.getGraphInfo(again))
