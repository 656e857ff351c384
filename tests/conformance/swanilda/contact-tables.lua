-- as: simulation
-- passes: 6
-- spec: dynamics 4; every call of sysCall_contact has a table of its own, as far as a script can tell
-- topic: dynamics
sim = require 'sim'

local function box(x, z, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setBoolProperty(shape, 'dynamic', dynamic)
    sim.setBoolProperty(shape, 'respondable', true)
    sim.setIntProperty(shape, 'respondableMask', 0xffff)
    return shape
end

local expected, kept, pairs_seen = {}, {}, {}
for i = 1, 3 do
    local lower, upper = box(i, 0, false), box(i, 0.099, true)
    expected[lower .. ' ' .. upper], expected[upper .. ' ' .. lower] = true, true
end

local function peek()
    local _, table = debug.getlocal(2, 1)
    kept[#kept + 1] = table
end

local last
local ways = {
    function(data) pairs_seen[#pairs_seen + 1] = data.handle1 .. ' ' .. data.handle2 end,
    function(data) kept[#kept + 1] = data end,
    function(data) peek() end,
    function(data) last = function() return data end kept[#kept + 1] = last() end,
    function(data) pairs_seen[#pairs_seen + 1] = data.handle1 .. ' ' .. data.handle2 data.handle1, data.engine = 0, nil end,
    function(data, ...) local all = {data, ...} kept[#kept + 1] = all[1] end,
}

local function check(way)
    local distinct, count, right = {}, 0, true
    for _, data in ipairs(kept) do
        if not distinct[data] then count = count + 1 end
        distinct[data] = true
        right = right and expected[data.handle1 .. ' ' .. data.handle2] and data.engine == sim.physics_bullet
    end
    for _, names in ipairs(pairs_seen) do right = right and expected[names] end
    local calls = #kept + #pairs_seen
    print(('way %d: called: %s, tables distinct: %s, values right: %s'):format(way, calls > 20, count == #kept, right == true))
    kept, pairs_seen = {}, {}
end

-- Only callbacks that are there after the text has run are called.
function sysCall_contact() end

local way = 0
function sysCall_actuation()
    way = way + 1
    sysCall_contact = ways[way]
end

function sysCall_sensing()
    if ways[way] then check(way) end
end
