-- as: sandbox
-- passes: 0
-- spec: data 2, data 4; custom data as strings, buffers and tables, the kind they were written as, signals of bytes, persistent data
-- topic: custom data
sim = require 'sim'

local a, b = sim.createDummy(0.01), sim.createDummy(0.01)
local function kinds(object)
    local info = sim.unpackTable(sim.readCustomStringData(object, '__info__'))
    local t = {}
    for tag, block in pairs(info.blocks) do t[#t + 1] = tag .. ' ' .. block.type end
    table.sort(t)
    return table.concat(t, ', ')
end

-- Strings and buffers.
sim.writeCustomBufferData(a, 'x', tobuffer('bytes'))
print(sim.readCustomBufferData(a, 'x'), sim.readCustomDataBlock(a, 'x'), sim.readCustomBufferData(a, 'none'), sim.readCustomDataBlock(a, 'none'))
sim.writeCustomDataBlock(a, 'x', 'text')
print(sim.readCustomStringData(a, 'x'), table.concat(sim.readCustomDataBlockTags(a), ' '))
sim.writeCustomDataBlock(a, 'x')
print(sim.readCustomDataBlock(a, 'x'), sim.readCustomDataBlockTags(a))
sim.writeCustomBufferData(a, 'x', tobuffer('bytes'))
sim.writeCustomBufferData(a, 'x')
print(sim.readCustomDataBlockTags(a))
sim.writeCustomDataBlock(a, 'y', 'text')
sim.writeCustomDataBlock(a, 'y', '')
print(sim.readCustomDataBlockTags(a))

-- Kinds.
print(sim.readCustomDataBlockEx(a, 'none'))
sim.writeCustomDataBlockEx(a, 'k', 'text', {dataType = 'mine'})
sim.writeCustomDataBlockEx(a, 'l', 'text')
sim.writeCustomDataBlock(a, 'm', 'text')
print('written', sim.readCustomDataBlockEx(a, 'k'))
sim.writeCustomDataBlockEx(a, 'one', 'x')
print('a byte', sim.readCustomDataBlockEx(a, 'one'))
print('without a kind', sim.readCustomDataBlockEx(a, 'l'))
print('otherwise', sim.readCustomDataBlockEx(a, 'm'))
sim.writeCustomDataBlockEx(a, 'k', 'other', {dataType = 'another'})
print('changed', sim.readCustomDataBlockEx(a, 'k'))
sim.writeCustomDataBlockEx(a, 'k', 'other')
print('taken away', sim.readCustomDataBlockEx(a, 'k'))
sim.writeCustomDataBlockEx(a, 'k', 'again', {dataType = 'mine'})
sim.writeCustomDataBlockEx(a, 'k', '', {dataType = 'mine'})
print('removed', sim.readCustomDataBlockEx(a, 'k'))
sim.writeCustomDataBlockEx(a, 'k', nil, {dataType = 'mine'})
print('nothing', sim.readCustomDataBlockEx(a, 'k'))
print(kinds(a) == '')
sim.writeCustomDataBlockEx(a, '__info__', sim.packTable{blocks = {m = {type = 'told'}}}, {dataType = 'not kept'})
print('told', sim.readCustomDataBlockEx(a, 'm'))
print(select(2, sim.readCustomDataBlockEx(a, '__info__')), kinds(a))

-- The same tag on several objects: each has its own kind.
local c, d, e, f, g = sim.createDummy(0.01), sim.createDummy(0.01), sim.createDummy(0.01), sim.createDummy(0.01), sim.createDummy(0.01)
sim.writeCustomDataBlockEx(c, 'k', 'x', {dataType = 'A'})
sim.writeCustomDataBlockEx(d, 'k', 'x', {dataType = 'B'})
sim.writeCustomDataBlockEx(e, 'k', 'x', {dataType = 'B'})
sim.writeCustomDataBlockEx(g, 'k', 'x')
sim.writeCustomDataBlockEx(f, 'l', 'x', {dataType = 'B'})
sim.writeCustomDataBlockEx(f, 'k', 'x', {dataType = 'B'})
print(kinds(c), kinds(d), kinds(e), kinds(f), table.concat(sim.readCustomDataTags(g), ' '))
print('a byte', sim.readCustomDataBlockEx(c, 'k'), sim.readCustomDataBlock(g, 'k'), sim.readCustomDataBlockEx(g, 'k'))
sim.writeCustomDataBlockEx(e, 'k', 'x')
sim.writeCustomDataBlockEx(d, 'k', 'x', {dataType = 'C'})
print(kinds(e) == '', kinds(d))

-- Tables: what is written often is the same on each object as when it is written once.
for round = 1, 3 do
    for i = 1, 18 do
        sim.writeCustomTableData(a, 'tag' .. i, {round, i})
        sim.writeCustomTableData(b, 'tag' .. i, {round, i}, i % 2 == 0 and {dataType = 'cbor'} or {})
    end
end
print(kinds(a))
print(kinds(b))
local sum = 0
for i = 1, 18 do
    local x, y = sim.readCustomTableData(a, 'tag' .. i), sim.readCustomTableData(b, 'tag' .. i, {})
    sum = sum + 100 * x[1] + x[2] + 100 * y[1] + y[2]
end
print(sum)
print(sim.readCustomStringData(b, 'tag2') == tostring(sim.packTable({3, 2}, 1)), sim.readCustomStringData(b, 'tag1') == tostring(sim.packTable{3, 1}))
print(select(2, sim.readCustomDataBlockEx(b, 'tag2')), select(2, sim.readCustomDataBlockEx(b, 'tag1')))
for i = 1, 17 do sim.writeCustomTableData(a, 'tag' .. i, {}) end
print(kinds(a), next(sim.readCustomTableData(a, 'tag1')), next(sim.readCustomTableData(a, 'tag18')))
sim.writeCustomTableData(a, 'tag18', {1}, {dataType = 'cbor'})
print(kinds(a))
sim.writeCustomTableData(a, 'tag18', {1}, {dataType = 'table'})
print(kinds(a), sim.readCustomStringData(a, 'tag18') == tostring(sim.packTable{1}))
local function refused(f)
    local _, message = pcall(f)
    print(message)
end
refused(function() sim.writeCustomTableData(a, 'tag', 5) end)
refused(function() sim.writeCustomTableData(a, 5, {}) end)
refused(function() sim.writeCustomTableData('a', 'tag', {}) end)
refused(function() sim.writeCustomTableData(a, 'tag') end)
refused(function() sim.writeCustomTableData(a, 'tag', {}, 5) end)
refused(function() local _ = sim.readCustomTableData(a, 5) end)
refused(function() local _ = sim.readCustomTableData('a', 'tag') end)
refused(function() local _ = sim.readCustomTableData(a) end)
refused(function() local _ = sim.readCustomTableData(a, 'tag', 5) end)
print(#sim.readCustomTableData(a, 'tag18', {}))

-- Signals of bytes.
print(sim.setBufferSignal('s', 'abc'), isbuffer(sim.getBufferSignal('s')), tostring(sim.getBufferSignal('s')), sim.getStringSignal('s'))
print(sim.clearBufferSignal('s'), sim.clearBufferSignal('s'), select('#', sim.getBufferSignal('s')))

-- Persistent data.
print(#sim.getMatchingPersistentDataTags('.'))
for _, tag in ipairs{'one', 'two', 'three', 'other'} do sim.persistentDataWrite(tag, 'x', 0) end
local tags = sim.getMatchingPersistentDataTags('^t')
table.sort(tags)
print(table.concat(tags, ' '), #sim.getMatchingPersistentDataTags('none'), #sim.getMatchingPersistentDataTags('o'))
