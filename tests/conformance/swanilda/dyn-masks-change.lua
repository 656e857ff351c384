-- as: simulation
-- passes: 60
-- engine: bullet278
-- spec: dynamics 4; lower half of the mask within a tree, upper half between trees; another tree or mask counts at once
-- tol: 0
-- topic: dynamics
sim = require 'sim'

local function box(x, z, dynamic, mask)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable_mask, mask)
    return shape
end

-- A box lies on another one; both are leaves of trees of their own, or of different branches of one.
local function pair(x, sameTree, lower, upper)
    local it = {below = box(x, 0.5, false, lower), above = box(x, 0.6, true, upper)}
    local roots = {sim.createDummy(0.01), sim.createDummy(0.01)}
    for i, shape in ipairs{it.below, it.above} do
        local branch = sim.createDummy(0.01)
        sim.setObjectParent(branch, sameTree and roots[1] or roots[i], true)
        sim.setObjectParent(shape, branch, true)
    end
    it.roots = roots
    return it
end

local pairs_

function sysCall_init()
    pairs_ = {
        pair(0, true, 0x0001, 0x0101), -- a bit in common in the lower half
        pair(1, true, 0x0101, 0x0102), -- one in the upper half only
        pair(2, false, 0x0101, 0x0102),
        pair(3, false, 0x0001, 0x0101),
        pair(4, true, 0x0101, 0x0201), -- will be of different trees
        pair(5, false, 0x0101, 0x0102), -- will be of one tree
        pair(6, false, 0xffff, 0xffff), -- the mask will change
        pair(7, false, 0xffff, 0xffff), -- will not be respondable
        pair(8, false, 0xffff, 0xffff), -- the floor will not
    }
end

local steps = 0

function sysCall_actuation()
    steps = steps + 1
    if steps ~= 20 then return end
    sim.setObjectParent(pairs_[5].above, -1, true)
    sim.setObjectParent(pairs_[6].roots[2], pairs_[6].below, true)
    sim.setObjectInt32Param(pairs_[7].above, sim.shapeintparam_respondable_mask, 0x00ff)
    sim.setObjectInt32Param(pairs_[8].above, sim.shapeintparam_respondable, 0)
    sim.setObjectInt32Param(pairs_[9].below, sim.shapeintparam_respondable, 0)
end

function sysCall_sensing()
    if steps ~= 18 and steps ~= 36 then return end
    local rests = {}
    for i, it in ipairs(pairs_) do rests[i] = sim.getObjectPosition(it.above)[3] > 0.55 and 'rests' or 'falls' end
    print(table.concat(rests, ' '))
end
