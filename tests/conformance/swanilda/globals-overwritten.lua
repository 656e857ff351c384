-- topic: library
-- as: sandbox
-- passes: 0
-- spec: vrep-era 2.1
-- note: what a script does with its globals changes nothing in the library; first all of them at once, before anything is loaded, then each in turn
local sim = require 'sim'
local _G, error, ipairs, next, pairs, pcall, print, rawset, sort, tostring, type, concat =
    _G, error, ipairs, next, pairs, pcall, print, rawset, table.sort, tostring, type, table.concat
local format = string.format
local dummy = sim.createDummy(0.01)
local child = sim.createDummy(0.01)
sim.setObjectParent(child, dummy)
sim.setObjectAlias(dummy, 'sensor')

local function close(a, b) return a - b < 1e-9 and b - a < 1e-9 end

-- Each returns true if all went well.
local calls = {
    getObjectHandle = function() return sim.getObjectHandle('/sensor', {noError = true}) == dummy end,
    getObject = function() return sim.getObject('/nowhere', {noError = true}) == -1 end,
    getObjectAliasRelative = function() return sim.getObjectAliasRelative(child, dummy, 0) == './dummy' end,
    customTable = function()
        sim.writeCustomTableData(dummy, 'data', {a = {1, 2}})
        return sim.readCustomTableData(dummy, 'data').a[2] == 2
    end,
    packTable = function() return sim.unpackTable(sim.packTable({1, {2}}))[2][1] == 2 end,
    path = function()
        local path = {0, 0, 0, 1, 0, 0, 1, 1, 0}
        local lengths, total = sim.getPathLengths(path, 3)
        local config = sim.getPathInterpolatedConfig(path, lengths, total / 2)
        return close(total, 2) and close(config[1], 1)
    end,
    createPath = function()
        local path = sim.createPath({0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1})
        sim.removeObjects(sim.getObjectsInTree(path))
        return true
    end,
    collection = function()
        local collection = sim.createCollection()
        sim.addItemToCollection(collection, sim.handle_single, dummy, 0)
        sim.destroyCollection(collection)
        return true
    end,
    visitTree = function()
        local count = 0
        sim.visitTree(dummy, function() count = count + 1 end)
        return count == 2
    end,
    colour = function()
        local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1})
        local previous = sim.changeEntityColor(shape, {1, 0, 0})
        sim.restoreEntityColor(previous)
        return sim.removeObjects({shape}) == nil or true
    end,
    angles = function()
        local a, b, c = sim.yawPitchRollToAlphaBetaGamma(0.1, 0.2, 0.3)
        local yaw, pitch, roll = sim.alphaBetaGammaToYawPitchRoll(a, b, c)
        return close(yaw, 0.1) and close(pitch, 0.2) and close(roll, 0.3)
    end,
    tags = function() return #sim.getObjectsWithTag('none') == 0 end,
    property = function() sim.setProperty(dummy, 'customData.x', 1) return sim.getProperty(dummy, 'customData.x') == 1 end,
}

local function failures()
    local failed = {}
    for name, call in pairs(calls) do
        local ok, result = pcall(call)
        if not ok or result ~= true then failed[#failed + 1] = name .. ' (' .. tostring(result) .. ')' end
    end
    sort(failed)
    return failed
end

local names = {}
for name, value in next, _G do
    if type(name) == 'string' and name ~= '_G' and (type(value) == 'function' or type(value) == 'table') then
        names[#names + 1] = name
    end
end
sort(names)

local saved = {}
for _, name in ipairs(names) do
    saved[name] = _G[name]
    rawset(_G, name, 'overwritten')
end
local failed = failures()
for name, value in next, saved do rawset(_G, name, value) end
print('all', concat(failed, ', '))

for _, name in ipairs(names) do
    local value = _G[name]
    rawset(_G, name, 'overwritten')
    failed = failures()
    rawset(_G, name, value)
    if #failed > 0 then print(name, concat(failed, ', ')) end
end
print(#names > 50)
