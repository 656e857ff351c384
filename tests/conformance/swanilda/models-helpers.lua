-- topic: modules
-- as: customization
-- passes: 0
-- loops: 10
-- spec: models 7; Graph, utils and the globals it brings, checkmodel, simQHull, the server of the old remote API
sim = require 'sim'

local Graph = require 'Graph'
local g = Graph(true)
for _, id in ipairs{'a', 'b', 'c', 1} do g:addVertex(id, id) end
g:addEdge('a', 'b', 'ab')
g:addEdge('b', 'c')
g:addEdge('c', 'b')
print(g:vertexCount(), g:edgeCount(), g:isDirected(), g:getEdge('a', 'b'), g:hasEdge('b', 'a'), g:getVertex('zz'))
print(pcall(g.addVertex, g, 'a'))
print(pcall(g.addVertex, g, {}))
print(g:getOutEdges('a'), g:getInEdges('b'))
local function sizes(list)
    local t = {}
    for i, part in ipairs(list) do t[i] = part:vertexCount() end
    return t
end
print(sizes(g:connectedComponents()), sizes(g:connectedComponents(true)))
print(g:getSourcesAndSinks())
local h = Graph()
h:addVertex('x')
h:addVertex('y')
h:addEdge('x', 'y')
print(h:hasEdge('y', 'x'), h:union(g):vertexCount())
print(h:tographviz{nodeStyle = function(id) return {label = id:upper()} end})
g:removeVertex('b')
print(g:edgeCount(), g:getAllVertices())

utils = require 'utils'
print(utils.getCheckboxValFromBool(true), utils.getRadiobuttonValFromBool(false), utils.isPluginLoaded('UI'), utils.isPluginLoaded('MTB'))
print(getObjectHandle_noError('nothing'), stringToArray('AB'), executeCode('x = 1'))
print(table.tostring{1, 'a', b = {2}}, math.hypotn(2, 3, 6), string.formatex('%s|%d', {1}, 2))
print(string.split('a,b,,c', ','))
print(pcall(asserttype, 1, 'string'))
utils.writeSessionPersistentObjectData(sim.getObject('.'), 'tag', 1, 'two')
print(utils.readSessionPersistentObjectData(sim.getObject('.'), 'tag'))
print(#utils.luac('return 1') > 0, pcall(function() return utils.unittest end))
local box = createOpenBox({1, 1, 0.5}, 0.1, 0.1, 1000, 1, true, true, {1, 0, 0})
print(sim.getShapeBB(box), math.floor(sim.getShapeMass(box) + 0.5))
local ui = utils.createCustomUi('<edit id="3" value="x"/>', 'Title', 'bottomRight', true, 'closed')
print(require('simUI').getTitle(ui), require('simUI').getEditValue(ui, 3))

local base = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1}, 0)
local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
local arm = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}, 0)
sim.setObjectAlias(base, 'base')
sim.setObjectAlias(arm, 'arm')
for _, body in ipairs{base, arm} do
    sim.setBoolProperty(body, 'dynamic', true)
    sim.setShapeMass(body, body == base and 100 or 1)
end
sim.setObjectParent(joint, base, false)
sim.setObjectParent(arm, joint, false)
print(#require('checkmodel').check(base), require('checkmodel').buildDynamicObjectsGraph(base):edgeCount())

local vertices, indices = require('simQHull').compute({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 0.1}, true)
print(#vertices, #indices)

function sysCall_init()
    local server = sim.createScript(sim.scripttype_customization, "require('b0RemoteApiServer')")
    sim.initScript(server)
    print((pcall(require, 'models.arucoMarker_customization')))
end
