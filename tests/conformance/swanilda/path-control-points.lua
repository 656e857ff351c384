-- as: customization
-- passes: 0
-- loops: 30
-- spec: paths 2; the path object: its control points, what follows when they are moved, copied and removed; options 1 and 4
-- tol: 1e-6
-- topic: motion
sim = require 'sim'

local function poses(...)
    local t = {}
    for _, p in ipairs{...} do for _, x in ipairs{p[1], p[2], p[3], 0, 0, 0, 1} do t[#t + 1] = x end end
    return t
end

local function numbers(object, name) return sim.unpackDoubleTable(sim.getBufferProperty(object, 'customData.' .. name)) end

local function children(object, type)
    local found = {}
    for i = 0, 99 do
        local child = sim.getObjectChild(object, i)
        if child < 0 then return found end
        if sim.getObjectType(child) == type then found[#found + 1] = child end
    end
end

local function shape(object) return children(object, sim.sceneobject_shape)[1] end
local function ends(path) return string.format('%.3f %.3f %.3f', path[1], path[#path - 6], path[#path - 5]) end

function sysCall_init()
    path = sim.createPath(poses({0, 0, 0}, {1, 0, 0}, {1, 1, 0}), 1 | 4, 50)
    sim.setObjectPosition(path, {5, 5, 5})
    points = children(path, sim.sceneobject_dummy)
    print(#points, sim.getObjectAlias(points[1]), table.unpack(sim.getObjectPosition(points[3])))
    print(#children(path, sim.sceneobject_script), #children(path, sim.sceneobject_shape), ends(numbers(path, 'PATH')))
    local vertices = sim.getShapeMesh(shape(path))
    print(#vertices // 3)
    other = sim.copyPasteObjects({path}, 1)[1]
    print(#children(other, sim.sceneobject_dummy), ends(numbers(other, 'PATH')))
end

local passes = 0

function sysCall_nonSimulation()
    passes = passes + 1
    if passes == 2 then
        sim.setObjectPosition(points[1], {-1, 0, 0}, path)
        before = shape(path)
    elseif passes == 4 then
        print('moved', ends(numbers(path, 'PATH')), numbers(path, 'PATHCTRLPTS')[1], sim.isHandle(before), #children(path, sim.sceneobject_shape))
        print('the copy', ends(numbers(other, 'PATH')))
        sim.removeObjects{points[3]}
    elseif passes == 6 then
        print('removed', ends(numbers(path, 'PATH')), #numbers(path, 'PATHCTRLPTS') // 7)
        local copy = sim.copyPasteObjects({points[1]}, 0)[1]
        sim.setObjectParent(copy, path, true)
        sim.setObjectPosition(copy, {0, 3, 0}, path)
    elseif passes == 8 then
        local control = numbers(path, 'PATHCTRLPTS')
        print('copied', #control // 7, control[1], control[9], control[15])
        sim.setObjectPosition(path, {0, 0, 0})
        sim.startSimulation()
    end
end

function sysCall_actuation()
    if said then return end
    said = true
    print('hidden', sim.getModelProperty(path) & sim.modelproperty_not_visible ~= 0, #numbers(path, 'PATH') // 7)
    sim.stopSimulation()
end

