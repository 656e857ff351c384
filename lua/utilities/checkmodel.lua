--[[
Looks for what makes the physics of a model hard: masses of linked bodies that differ much, and inertias that do not fit their masses.

    check(model)                                  prints what is doubtful, and returns the lines
    buildObjectsGraph(parent), buildDynamicObjectsGraph(parent)     the objects of a tree, or those that take part in dynamics, as a Graph
    checkConnectedComponentMasses(graph, limit, report)             of one connected part
    showObjectsGraph(graph)                       a picture by Graphviz's `dot`; returns the name of the file
]]

local sim = _quietRequire 'sim'
local Graph = require 'Graph'
local checkmodel = {}

local LIMIT <const> = 10 -- ratio of the masses of linked bodies

--- The objects of a tree, with an edge from each parent to its children.
function checkmodel.buildObjectsGraph(parent, graph)
    graph = graph or Graph(true)
    for _, object in ipairs(sim.getObjectsInTree(parent)) do
        if not graph:hasVertex(object) then graph:addVertex(object) end
        local above = sim.getObjectParent(object)
        if above ~= -1 and graph:hasVertex(above) and not graph:hasEdge(above, object) then graph:addEdge(above, object) end
    end
    return graph
end

local function isBody(object)
    return sim.getObjectType(object) == sim.sceneobject_shape
        and (sim.getBoolProperty(object, 'dynamic') or sim.getBoolProperty(object, 'respondable'))
end

-- The body that carries an object: the next one above it, within the tree.
local function carrier(object, top)
    local above = object
    while above ~= top do
        above = sim.getObjectParent(above)
        if above == -1 then return nil end
        if isBody(above) then return above end
    end
end

--- The bodies of a tree, with an edge between those that a joint or force sensor links.
function checkmodel.buildDynamicObjectsGraph(parent)
    local graph = Graph(false)
    for _, object in ipairs(sim.getObjectsInTree(parent)) do
        if isBody(object) then graph:addVertex(object) end
    end
    for _, object in ipairs(sim.getObjectsInTree(parent)) do
        local link = isBody(object) and object ~= parent and sim.getObjectParent(object) or -1
        local kind = link ~= -1 and sim.getObjectType(link)
        local linked = (kind == sim.sceneobject_joint or kind == sim.sceneobject_forcesensor) and carrier(link, parent)
        if linked and not graph:hasEdge(linked, object) then graph:addEdge(linked, object, link) end
    end
    return graph
end

--- What is doubtful about the masses of linked bodies.
-- @param limit largest ratio that is fine
-- @param report list to which lines are added
function checkmodel.checkConnectedComponentMasses(graph, limit, report)
    report, limit = report or {}, limit or LIMIT
    for _, edge in ipairs(graph:getAllEdges()) do
        local isDynamic = sim.getBoolProperty(edge.id1, 'dynamic') and sim.getBoolProperty(edge.id2, 'dynamic')
        local a, b = sim.getShapeMass(edge.id1), sim.getShapeMass(edge.id2)
        local ratio = math.max(a, b) / math.max(math.min(a, b), 1e-12)
        if isDynamic and ratio > limit then
            report[#report + 1] = ('%s (%g kg) and %s (%g kg): the ratio of their masses is %.1f'):format(
                sim.getObjectAlias(edge.id1, 1), a, sim.getObjectAlias(edge.id2, 1), b, ratio)
        end
    end
    return report
end

local function checkInertia(object, report)
    local inertia = sim.getShapeInertia(object)
    local x, y, z = inertia[1], inertia[5], inertia[9]
    if x + y < z or y + z < x or z + x < y then
        report[#report + 1] = ('%s: no body has this inertia: a moment is larger than the sum of the others'):format(
            sim.getObjectAlias(object, 1))
    end
end

--- Prints what is doubtful about a model.
-- @return the lines
function checkmodel.check(model)
    local graph, report = checkmodel.buildDynamicObjectsGraph(model), {}
    for _, part in ipairs(graph:connectedComponents()) do checkmodel.checkConnectedComponentMasses(part, LIMIT, report) end
    for _, object in ipairs(graph:getAllVertices()) do
        if sim.getBoolProperty(object, 'dynamic') then checkInertia(object, report) end
    end
    for _, line in ipairs(report) do print(line) end
    return report
end

--- Draws a graph of objects.
function checkmodel.showObjectsGraph(graph)
    return graph:render{nodeStyle = function(object) return {label = sim.getObjectAlias(object, 1)} end}
end

return checkmodel
