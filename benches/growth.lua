-- Run by growth.py, which passes `case` and `n`. A case prepares a scene with `n` of something and returns what is measured.
-- Prints the processor time of that, in seconds, and how much larger the process became, in kilobytes.
sim = require 'sim'

local function for_all(n, action)
    local results = {}
    for i = 1, n do results[i] = action(i) end
    return results
end

local function dummies(n)
    return for_all(n, function() return sim.createDummy(0.01) end)
end

--- Dummies with an alias of their own each.
local function named(n)
    return for_all(n, function(i)
        local dummy = sim.createDummy(0.01)
        sim.setObjectAlias(dummy, 'd' .. i)
        return dummy
    end)
end

--- Dummies, each of which hangs on the one before.
local function chain(n)
    local members = dummies(n)
    for i = n, 2, -1 do sim.setObjectParent(members[i], members[i - 1], true) end
    return members
end

--- Cuboids that stand apart on a square.
local function cuboids(n)
    local width = math.ceil(math.sqrt(n))
    return for_all(n, function(i)
        local cuboid = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        sim.setObjectPosition(cuboid, {i % width, i // width, 0.05})
        return cuboid
    end)
end

--- All aliases of equal objects in a way of writing them.
local function aliases(make, option)
    return function(n)
        local members = make(n)
        return function()
            for i = 1, n do sim.getObjectAlias(members[i], option) end
        end
    end
end

--- Points on a line, farther from each other than a voxel is wide.
local function point(i)
    return {0.1 * (i % 100), 0.1 * (i // 100), 0}
end

local function points(n)
    local all = {}
    for i = 1, n do table.move(point(i), 1, 3, #all + 1, all) end
    return all
end

--- Triangles of a wavy surface with about `n` of them.
local function surface(n)
    local width = math.ceil(math.sqrt(n / 2)) + 1
    local vertices, indices = {}, {}
    for i = 0, width * width - 1 do
        local x, y = i % width, i // width
        table.move({0.01 * x, 0.01 * y, 0.01 * math.sin(x + y)}, 1, 3, #vertices + 1, vertices)
        if x > 0 and y > 0 then
            table.move({i - width - 1, i - width, i, i - width - 1, i, i - 1}, 1, 6, #indices + 1, indices)
        end
    end
    return vertices, indices
end

local cases = {}

function cases.signals_set(n)
    return function()
        for i = 1, n do sim.setIntProperty(sim.handle_scene, 'signal.s' .. i, i) end
    end
end

function cases.signals_get(n)
    cases.signals_set(n)()
    return function()
        for i = 1, n do sim.getIntProperty(sim.handle_scene, 'signal.s' .. i) end
    end
end

function cases.signals_removed(n)
    cases.signals_set(n)()
    return function()
        for i = 1, n do sim.removeProperty(sim.handle_scene, 'signal.s' .. i) end
    end
end

function cases.custom_properties_set(n)
    local dummy = sim.createDummy(0.01)
    return function()
        for i = 1, n do sim.setIntProperty(dummy, 'customData.p' .. i, i) end
    end
end

function cases.custom_properties_listed(n)
    local dummy = sim.createDummy(0.01)
    for i = 1, n do sim.setIntProperty(dummy, 'customData.p' .. i, i) end
    return function()
        local index = 0
        while sim.getPropertyName(dummy, index) do index = index + 1 end
    end
end

--- Poses in the world are composed from the object upwards, since rounding depends on the order, but only so far.
function cases.chain_from_the_root(n)
    local members = dummies(n)
    return function()
        for i = 2, n do sim.setObjectParent(members[i], members[i - 1], true) end
    end
end

function cases.chain_that_keeps_poses(n)
    local members = dummies(n)
    return function()
        for i = 2, n do sim.setObjectParent(members[i], members[i - 1], false) end
    end
end

function cases.chain_from_the_end(n)
    local members = dummies(n)
    return function()
        for i = n, 2, -1 do sim.setObjectParent(members[i], members[i - 1], true) end
    end
end

function cases.chain_taken_apart(n)
    local members = chain(n)
    return function()
        for i = n, 2, -1 do sim.setObjectParent(members[i], -1, true) end
    end
end

function cases.chain_copied(n)
    local members = chain(n)
    return function() sim.copyPasteObjects(members, 0) end
end

function cases.children_moved(n)
    local members, parent = dummies(n), sim.createDummy(0.01)
    return function()
        for i = 1, n do sim.setObjectParent(members[i], parent, true) end
    end
end

function cases.copied(n)
    local members = dummies(n)
    return function() sim.copyPasteObjects(members, 0) end
end

function cases.created(n)
    return function() dummies(n) end
end

function cases.renamed(n)
    local members = dummies(n)
    return function()
        for i = 1, n do sim.setObjectAlias(members[i], 'd' .. i) end
    end
end

function cases.found_by_name(n)
    named(n)
    return function()
        for i = 1, n do sim.getObject('/d' .. i) end
    end
end

function cases.found_by_position(n)
    for_all(n, function() sim.setObjectAlias(sim.createDummy(0.01), 'd') end)
    return function()
        for i = 0, n - 1 do sim.getObject('/d[' .. i .. ']') end
    end
end

function cases.found_by_index(n)
    for_all(n, function() sim.setObjectAlias(sim.createDummy(0.01), 'd') end)
    return function()
        for i = 0, n - 1 do sim.getObject('/d', {index = i}) end
    end
end

function cases.found_below(n)
    local parent = sim.createDummy(0.01)
    for _, member in ipairs(named(n)) do sim.setObjectParent(member, parent, true) end
    return function()
        for i = 1, n do sim.getObject('./d' .. i, {proxy = parent}) end
    end
end

function cases.not_found(n)
    named(n)
    return function()
        for i = 1, n do sim.getObject('/x' .. i, {noError = true}) end
    end
end

cases.aliases_among_siblings = aliases(dummies, 0)
cases.aliases_short = aliases(dummies, 1)
cases.aliases_full = aliases(dummies, 2)
cases.aliases_unique = aliases(named, 3)
cases.aliases_printed = aliases(dummies, 5)
cases.aliases_counted = aliases(dummies, 6)

function cases.listed(n)
    for i = 1, n / 2 do sim.createDummy(0.01); sim.createForceSensor(0, {0, 0, 0, 0, 0}, {0.01, 1, 1, 0, 0}) end
    return function()
        local index = 0
        while sim.getObjects(index, sim.sceneobject_dummy) >= 0 do index = index + 1 end
    end
end

function cases.removed_together(n)
    local members = dummies(n)
    return function() sim.removeObjects(members) end
end

function cases.removed_one_by_one(n)
    local members = dummies(n)
    return function()
        for i = 1, n do sim.removeObjects{members[i]} end
    end
end

function cases.grouped(n)
    local members = cuboids(n)
    return function() sim.groupShapes(members) end
end

function cases.ungrouped(n)
    local compound = sim.groupShapes(cuboids(n))
    return function() sim.ungroupShape(compound) end
end

function cases.scene_saved(n)
    named(n)
    local file = os.tmpname()
    return function() sim.saveScene(file) end, function() os.remove(file) end
end

function cases.scene_loaded(n)
    named(n)
    local file = os.tmpname() .. '.ttm'
    local parent = sim.createDummy(0.01)
    for _, member in ipairs(sim.getObjectsInTree(sim.handle_scene, sim.sceneobject_dummy, 2)) do
        if member ~= parent then sim.setObjectParent(member, parent, true) end
    end
    sim.setModelProperty(parent, 0)
    sim.saveModel(parent, file)
    return function() sim.loadModel(file) end, function() os.remove(file) end
end

function cases.point_cloud_at_once(n)
    local cloud, all = sim.createPointCloud(0.02, 20, 0, 1), points(n)
    return function() sim.insertPointsIntoPointCloud(cloud, 0, all) end
end

function cases.point_cloud_in_pieces(n)
    local cloud = sim.createPointCloud(0.02, 20, 0, 1)
    return function()
        for i = 1, n do sim.insertPointsIntoPointCloud(cloud, 0, point(i)) end
    end
end

function cases.octree_in_pieces(n)
    local octree = sim.createOctree(0.05, 0, 1)
    return function()
        for i = 1, n do sim.insertVoxelsIntoOctree(octree, 0, point(i)) end
    end
end

--- A sensor detects after each voxel that is added.
function cases.octree_seen_in_pieces(n)
    local octree = sim.createOctree(0.05, 0, 1)
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(box, {0, 0, 1})
    return function()
        for i = 1, n do
            sim.insertVoxelsIntoOctree(octree, 0, point(i))
            sim.checkCollision(octree, box)
        end
    end
end

function cases.spheres(n)
    return function()
        for_all(n, function() sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1}) end)
    end
end

function cases.triangles(n)
    local vertices, indices = surface(50 * n)
    return function() sim.createShape(0, 0.5, vertices, indices) end
end

function cases.static_boxes(n)
    return function() cuboids(n) end
end

function cases.threads(n)
    local function idle() sim.yield() end
    return function()
        local threads = for_all(n, function() return coroutine.create(idle) end)
        for i = 1, n do coroutine.resume(threads[i]) end
    end
end

--- The cases below measure from the end of the preparation to the end of the first step, or the step number `steps`.
local stepped = {}

function stepped.scripts_first_step(n)
    for_all(n, function() sim.createScript(sim.scripttype_simulation, 'function sysCall_init() end', 0, 'lua') end)
end

function stepped.scripts_ten_steps(n)
    stepped.scripts_first_step(n)
    return 2, 12
end

function stepped.empty_callbacks_ten_steps(n)
    local text = 'function sysCall_actuation() end function sysCall_sensing() end'
    for_all(n, function() sim.createScript(sim.scripttype_simulation, text, 0, 'lua') end)
    return 3, 13
end

function stepped.static_boxes_first_step(n)
    cuboids(n)
end

function stepped.static_boxes_ten_steps(n)
    cuboids(n)
    return 2, 12
end

function stepped.dummies_ten_steps(n)
    dummies(n)
    return 2, 12
end

function stepped.signals_in_a_step(n)
    cases.signals_set(n)()
end

local begun

local function resident()
    for line in io.lines('/proc/self/status') do
        local kilobytes = line:match('^VmRSS:%s*(%d+)')
        if kilobytes then return tonumber(kilobytes) end
    end
end

local function begin()
    collectgarbage()
    local before = resident()
    local clock = os.clock()
    begun = function() return os.clock() - clock, resident() - before end
end

local function finish()
    local seconds, kilobytes = begun()
    print(string.format('%.9f\t%d', seconds, kilobytes))
    sim.quitSimulator()
end

function sysCall_init()
    if sim.getNamedStringParam('list') then
        for _, group in ipairs{cases, stepped} do
            for name in pairs(group) do print(name) end
        end
        return sim.quitSimulator()
    end
    local name, n = sim.getNamedStringParam('case'), tonumber(sim.getNamedStringParam('n'))
    if stepped[name] then
        first, last = stepped[name](n)
        sim.startSimulation()
        return begin()
    end
    local measured, tidy = cases[name](n)
    begin()
    measured()
    finish()
    if tidy then tidy() end
end

function sysCall_sensing()
    step = (step or 0) + 1
    if step == first then begin() end
    if step == (last or 1) then finish() end
end
