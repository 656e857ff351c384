-- Meshes without volume, without area, with holes; bodies and frames at the same place.
sim = require 'sim'
watch = require 'watch'

local meshes = {
    flat = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}},
    line = {{0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 1, 2}},
    point = {{0, 0, 0, 0, 0, 0, 0, 0, 0}, {0, 1, 2}},
    same = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0, 1, 1, 2}},
    huge = {{0, 0, 0, 1e200, 0, 0, 0, 1e200, 0, 0, 0, 1e200}, {0, 1, 2, 0, 1, 3, 1, 2, 3, 0, 2, 3}},
    tiny = {{0, 0, 0, 1e-200, 0, 0, 0, 1e-200, 0, 0, 0, 1e-200}, {0, 1, 2, 0, 1, 3, 1, 2, 3, 0, 2, 3}},
    inside = {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 2, 1, 0, 1, 2, 3}},
    unreal = {{0 / 0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}},
    beyond = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 7}},
    empty = {{}, {}},
}
local sizes = {{0, 0, 0}, {1e-300, 1, 1}, {1e200, 1, 1}, {-1, 1, 1}, {0.1, 0.1, 0}}

local function wake(shape, y)
    sim.setObjectPosition(shape, {0, y, 0.5})
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, 0)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    pcall(sim.computeMassAndInertia, shape, 1000)
end

function sysCall_init()
    local y = 0
    for _, mesh in pairs(meshes) do
        for convex = 0, 1 do
            local made, shape = pcall(sim.createShape or sim.createMeshShape, 0, 0, mesh[1], mesh[2])
            if made and shape >= 0 then
                sim.setObjectInt32Param(shape, sim.shapeintparam_convex or 3017, convex)
                wake(shape, y)
            end
            y = y + 0.1
        end
    end
    for kind = 1, 7 do
        for _, size in ipairs(sizes) do
            local made, shape = pcall(sim.createPrimitiveShape, kind, size)
            if made and shape >= 0 then wake(shape, y) end
        end
    end
    -- Everything at one place, linked in a circle.
    local stack = {}
    for i = 1, 6 do stack[i] = watch.box('stack' .. i, {10, 0, 1}, i > 1, true) end
    for i = 2, 6 do watch.link(i % 2 == 0 and watch.joint() or watch.sensor(), stack[i - 1], stack[i]) end
    for i = 1, 5 do
        local ends = {sim.createDummy(0.01), sim.createDummy(0.01)}
        sim.setObjectParent(ends[1], stack[i], false)
        sim.setObjectParent(ends[2], stack[i % 6 + 1], false)
        sim.setObjectInt32Param(ends[1], sim.dummyintparam_dummytype or 10000, 0)
        sim.setLinkDummy(ends[1], ends[2])
    end
    local floor = sim.createPrimitiveShape(sim.primitiveshape_plane, {100, 100, 0})
    sim.setObjectInt32Param(floor, sim.shapeintparam_respondable, 1)
end

function sysCall_sensing() watch.check() end

function sysCall_afterSimulation() print('all is well') end
