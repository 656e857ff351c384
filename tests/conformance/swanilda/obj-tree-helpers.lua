-- as: sandbox
-- passes: 0
-- spec: addressing 3, addressing 5, data 5, objects 1.4, shapes 3; visits, tags, references, relative aliases, sizes
-- tol: 1e-6
-- topic: objects
sim = require 'sim'

local handles, names = {}, {}

local function add(name, parent)
    local h = sim.createDummy(0.01)
    sim.setObjectAlias(h, name)
    if parent then sim.setObjectParent(h, handles[parent], true) end
    handles[name], names[h] = h, name
    return h
end

local function named(list)
    local t = {}
    for i, h in ipairs(list) do t[i] = names[h] or '?' end
    return '{' .. table.concat(t, ' ') .. '}'
end

local function refused(what, f)
    local _, message = pcall(f)
    print(what, message)
end

-- a (b (c d) e (f)), g
for _, entry in ipairs{{'a'}, {'b', 'a'}, {'c', 'b'}, {'d', 'b'}, {'e', 'a'}, {'f', 'e'}, {'g'}} do add(table.unpack(entry)) end

local visited
function visitor(h)
    visited[#visited + 1] = h
    return h ~= handles.b
end
local function visit(what, ...)
    visited = {}
    sim.visitTree(...)
    print(what, named(visited))
end
visit('visit', handles.a, function(h) visited[#visited + 1] = h end)
visit('without what is below b', handles.a, visitor)
visit('by name', handles.a, 'visitor')
visit('below b only', handles.b, visitor)
visit('all', sim.handle_scene, function(h) visited[#visited + 1] = h end)

for _, name in ipairs{'f', 'c', 'g', 'b'} do sim.writeCustomStringData(handles[name], 'mark', 'x') end
sim.writeCustomStringData(handles.d, 'other', 'x')
sim.setModelProperty(handles.b, 0)
print('tagged', named(sim.getObjectsWithTag('mark')), named(sim.getObjectsWithTag('mark', true)), named(sim.getObjectsWithTag('none')))

local a = handles.a
refused('no reference', function() sim.getReferencedHandle(a) end)
sim.addReferencedHandle(a, handles.c)
print('one', names[sim.getReferencedHandle(a)])
sim.addReferencedHandle(a, handles.b, {wholeTree = true})
print('with what is below', named(sim.getReferencedHandles(a)))
refused('several', function() sim.getReferencedHandle(a) end)
sim.addReferencedHandle(a, handles.g, 'tag')
sim.addReferencedHandle(a, handles.e, 'tag', {wholeTree = true})
print('tag', named(sim.getReferencedHandles(a, 'tag')), named(sim.getReferencedHandles(a)))
refused('several of a tag', function() sim.getReferencedHandle(a, 'tag') end)
sim.addReferencedHandle(a, handles.f, 'single', {})
print('one of a tag', names[sim.getReferencedHandle(a, 'single')])

-- Models: m above n; n holds p (q), m holds r.
for _, entry in ipairs{{'m'}, {'n', 'm'}, {'o', 'n'}, {'p', 'o'}, {'q', 'p'}, {'r', 'm'}, {'s', 'r'}, {'t', 's'}} do add(table.unpack(entry)) end
sim.setModelProperty(handles.m, 0)
sim.setModelProperty(handles.n, 0)
for _, pair in ipairs{
    {'q', 'q'}, {'q', 'p'}, {'q', 'o'}, {'q', 'n'}, {'q', 'm'}, {'p', 'q'}, {'o', 'q'}, {'n', 'q'}, {'m', 'q'}, {'t', 'q'}, {'q', 't'}, {'t', 'n'}, {'q', 'r'},
    {'n', 'm'}, {'m', 'n'}, {'f', 'c'}, {'c', 'f'}, {'d', 'c'}, {'a', 'f'}, {'g', 'a'}, {'q', 'a'}, {'e', 'b'}, {'f', 'b'},
} do
    local path = sim.getObjectAliasRelative(handles[pair[1]], handles[pair[2]])
    local found = sim.getObject(path, {proxy = handles[pair[2]], noError = true})
    print(pair[1] .. ' from ' .. pair[2], path, found == handles[pair[1]])
end
local twin = add('q', 'p')
print('twins', sim.getObjectAliasRelative(twin, handles.p), (sim.getObjectAliasRelative(twin, handles.p, 3):gsub('%d+', 'N')), sim.getObjectAliasRelative(twin, handles.n))

local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.2, 0.3})
local second = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
sim.setObjectPosition(second, {1, 2, 3})
sim.setObjectParent(second, box, true)
sim.setModelProperty(box, 0)
local function sizes(size) print(string.format('%.6f %.6f %.6f', table.unpack(size))) end
sizes(sim.getModelBB(box))
sim.setShapeBB(box, {0.4, 0.5, 0.6})
sizes(sim.getShapeBB(box))

-- References to what is gone, and twice to the same; the object itself is among those removed.
sim.addReferencedHandle(handles.g, handles.c, 'old')
sim.addReferencedHandle(handles.g, handles.c, 'old')
sim.addReferencedHandle(handles.g, handles.d, 'old')
sim.addReferencedHandle(handles.g, handles.g)
sim.removeObjects{handles.d}
sim.removeReferencedObjects(handles.g, 'old')
print('removed', sim.isHandle(handles.c), sim.isHandle(handles.g), #sim.getReferencedHandles(handles.g, 'old'), #sim.getReferencedHandles(handles.g))
sim.removeReferencedObjects(handles.g, 'old')
sim.removeReferencedObjects(handles.g)
print('removed itself', sim.isHandle(handles.g))
sim.addReferencedHandle(handles.e, handles.f)
sim.removeReferencedObjects(handles.e, '', true)
print('delayed', sim.isHandle(handles.f), #sim.getReferencedHandles(handles.e))
