--[[
Graphs of vertices and edges: `Graph = require 'Graph'`. Vertices have an id, a number or a string, and any information; edges too.

    Graph(directed), addVertex(id, info), removeVertex(id), getVertex(id), hasVertex(id), addEdge(a, b, info), removeEdge(a, b), getEdge(a, b),
    hasEdge(a, b), getOutEdges(id), getInEdges(id), getAllVertices(), getAllEdges(), vertexCount(), edgeCount(), union(other), isDirected(),
    connectedComponents(strongly), getSourcesAndSinks(), tographviz(options), render(options)

Lists are in the order in which vertices and edges were added.
]]

local class = require 'middleclass'

local Graph = class 'Graph'

local SEPARATOR <const> = '\0'

local function checkId(id)
    if type(id) ~= 'number' and type(id) ~= 'string' then error('bad id type', 3) end
end

-- A list with a place for each key: what is removed leaves no hole in what is read.
local function remove(list, key)
    for i, one in ipairs(list) do
        if one == key then return table.remove(list, i) end
    end
end

function Graph:initialize(directed)
    self.directed = directed or false
    self.vertices, self.order = {}, {}
    self.edges, self.edgeOrder = {}, {}
end

function Graph:isDirected() return self.directed end

function Graph:_getEdgeKey(a, b)
    local first, second = type(a) .. ':' .. tostring(a), type(b) .. ':' .. tostring(b)
    if not self.directed and second < first then first, second = second, first end
    return first .. SEPARATOR .. second
end

---------------------------------------------------------------- vertices

function Graph:addVertex(id, info)
    checkId(id)
    if self.vertices[id] then error('vertex already exists', 2) end
    self.vertices[id] = {id = id, info = info}
    self.order[#self.order + 1] = id
end

--- Removes a vertex with its edges.
function Graph:removeVertex(id)
    checkId(id)
    if not self.vertices[id] then error('vertex does not exist', 2) end
    for _, edge in ipairs(self:getAllEdges()) do
        if edge.id1 == id or edge.id2 == id then self:removeEdge(edge.id1, edge.id2) end
    end
    self.vertices[id] = nil
    remove(self.order, id)
end

--- What a vertex was added with, nil of one that is not there.
function Graph:getVertex(id)
    checkId(id)
    local vertex = self.vertices[id]
    return vertex and vertex.info
end

function Graph:hasVertex(id)
    checkId(id)
    return self.vertices[id] ~= nil
end

--- The ids.
function Graph:getAllVertices() return table.move(self.order, 1, #self.order, 1, {}) end

function Graph:vertexCount() return #self.order end

---------------------------------------------------------------- edges

function Graph:addEdge(a, b, info)
    checkId(a)
    checkId(b)
    if not (self.vertices[a] and self.vertices[b]) then error('vertex does not exist', 2) end
    local key = self:_getEdgeKey(a, b)
    if self.edges[key] then error('edge already exists', 2) end
    self.edges[key] = {id1 = a, id2 = b, info = info}
    self.edgeOrder[#self.edgeOrder + 1] = key
end

function Graph:removeEdge(a, b)
    local key = self:_getEdgeKey(a, b)
    if not self.edges[key] then error('edge does not exist', 2) end
    self.edges[key] = nil
    remove(self.edgeOrder, key)
end

--- What an edge was added with, nil of one that is not there.
function Graph:getEdge(a, b)
    local edge = self.edges[self:_getEdgeKey(a, b)]
    return edge and edge.info
end

function Graph:hasEdge(a, b) return self.edges[self:_getEdgeKey(a, b)] ~= nil end

--- Tables of id1, id2 and info.
function Graph:getAllEdges()
    local list = {}
    for i, key in ipairs(self.edgeOrder) do list[i] = self.edges[key] end
    return list
end

function Graph:edgeCount() return #self.edgeOrder end

-- The ids at the other end of the edges that begin (or end) at a vertex.
local function neighbours(graph, id, from, to)
    local list = {}
    for _, edge in ipairs(graph:getAllEdges()) do
        if edge[from] == id then
            list[#list + 1] = edge[to]
        elseif not graph.directed and edge[to] == id then
            list[#list + 1] = edge[from]
        end
    end
    return list
end

--- The vertices that edges from this one lead to.
function Graph:getOutEdges(id) return neighbours(self, id, 'id1', 'id2') end

--- The vertices from which edges lead to this one.
function Graph:getInEdges(id) return neighbours(self, id, 'id2', 'id1') end

---------------------------------------------------------------- whole graphs

--- A graph with the vertices and edges of both.
function Graph:union(other)
    local both = Graph(self.directed)
    for _, graph in ipairs{self, other} do
        for _, id in ipairs(graph.order) do
            if not both:hasVertex(id) then both:addVertex(id, graph:getVertex(id)) end
        end
        for _, edge in ipairs(graph:getAllEdges()) do
            if not both:hasEdge(edge.id1, edge.id2) then both:addEdge(edge.id1, edge.id2, edge.info) end
        end
    end
    return both
end

-- Everything that can be reached, without recursion.
local function reach(start, next)
    local found, pending, list = {[start] = true}, {start}, {}
    while #pending > 0 do
        local id = table.remove(pending)
        list[#list + 1] = id
        for _, other in ipairs(next(id)) do
            if not found[other] then
                found[other] = true
                pending[#pending + 1] = other
            end
        end
    end
    return found, list
end

local function subgraph(graph, isIn)
    local part = Graph(graph.directed)
    for _, id in ipairs(graph.order) do
        if isIn[id] then part:addVertex(id, graph:getVertex(id)) end
    end
    for _, edge in ipairs(graph:getAllEdges()) do
        if isIn[edge.id1] and isIn[edge.id2] then part:addEdge(edge.id1, edge.id2, edge.info) end
    end
    return part
end

--- The connected parts, as graphs.
-- @param strongly of a directed graph: vertices of a part can be reached from each other along the edges
function Graph:connectedComponents(strongly)
    local parts, known = {}, {}
    local function both(id)
        local list = self:getOutEdges(id)
        return table.move(self:getInEdges(id), 1, #self:getInEdges(id), #list + 1, list)
    end
    for _, id in ipairs(self.order) do
        if not known[id] then
            local isIn = reach(id, strongly and function(at) return self:getOutEdges(at) end or both)
            if strongly and self.directed then
                local back = reach(id, function(at) return self:getInEdges(at) end)
                for other in pairs(isIn) do isIn[other] = back[other] end
            end
            for other in pairs(isIn) do known[other] = true end
            parts[#parts + 1] = subgraph(self, isIn)
        end
    end
    return parts
end

--- The vertices without edges to them, and those without edges from them.
function Graph:getSourcesAndSinks()
    local sources, sinks = {}, {}
    for _, id in ipairs(self.order) do
        if #self:getInEdges(id) == 0 then sources[#sources + 1] = id end
        if #self:getOutEdges(id) == 0 then sinks[#sinks + 1] = id end
    end
    return sources, sinks
end

---------------------------------------------------------------- pictures

local function quoted(value) return '"' .. tostring(value):gsub('[\\"]', '\\%0') .. '"' end

local function attributesOf(style, ...)
    if type(style) == 'function' then style = style(...) end
    local parts, names = {}, {}
    for name in pairs(type(style) == 'table' and style or {}) do names[#names + 1] = name end
    table.sort(names)
    for i, name in ipairs(names) do parts[i] = name .. '=' .. quoted(style[name]) end
    return #parts > 0 and ' [' .. table.concat(parts, ', ') .. ']' or ''
end

--- The graph in the language of Graphviz.
-- @param options nodeStyle(id), edgeStyle(id1, id2): functions returning attributes, or tables of them
function Graph:tographviz(options)
    options = options or {}
    local lines = {self.directed and 'digraph {' or 'graph {'}
    for _, id in ipairs(self.order) do
        lines[#lines + 1] = ('    %s%s;'):format(quoted(id), attributesOf(options.nodeStyle, id))
    end
    local arrow = self.directed and '->' or '--'
    for _, edge in ipairs(self:getAllEdges()) do
        local style = attributesOf(options.edgeStyle, edge.id1, edge.id2)
        lines[#lines + 1] = ('    %s %s %s%s;'):format(quoted(edge.id1), arrow, quoted(edge.id2), style)
    end
    lines[#lines + 1] = '}'
    return table.concat(lines, '\n')
end

--- A picture made by Graphviz's program `dot`.
-- @param options those of tographviz; outputFile, format (png)
-- @return name of the file
function Graph:render(options)
    options = options or {}
    local format = options.format or 'png'
    local output = options.outputFile or os.tmpname() .. '.' .. format
    local input = os.tmpname()
    local file = assert(io.open(input, 'w'))
    file:write(self:tographviz(options))
    file:close()
    local result, message = _quietRequire('simSubprocess').exec('dot', {'-T' .. format, '-o' .. output, input})
    os.remove(input)
    if result ~= 0 then error('dot: ' .. tostring(message), 2) end
    return output
end

return Graph
