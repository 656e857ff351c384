-- Masses, inertias, forces and speeds nobody has: bodies alone, in contact, and in chains.
sim = require 'sim'
watch = require 'watch'

local unit = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}
local oddities = {
    massless = function(body) sim.setShapeMass(body, 0) end,
    negative = function(body) sim.setShapeMass(body, -1) end,
    heavy = function(body) sim.setShapeMass(body, 1e300) end,
    weightless = function(body) sim.setShapeMass(body, 1e-300) end,
    inertialess = function(body) sim.setShapeInertia(body, {0, 0, 0, 0, 0, 0, 0, 0, 0}, unit) end,
    singular = function(body) sim.setShapeInertia(body, {1, 0, 0, 0, 0, 0, 0, 0, 0}, unit) end,
    indefinite = function(body) sim.setShapeInertia(body, {-1, 0, 0, 0, 1, 0, 0, 0, 1}, unit) end,
    inert = function(body) sim.setShapeInertia(body, {1e300, 0, 0, 0, 1e300, 0, 0, 0, 1e300}, unit) end,
    eccentric = function(body) sim.setShapeInertia(body, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 0, 0, 1e200, 0, 1, 0, 0, 0, 0, 1, 0}) end,
    unreal = function(body) sim.setShapeInertia(body, {0 / 0, 0, 0, 0, 1, 0, 0, 0, 1}, unit) end,
    thrown = function(body) sim.setObjectFloatParam(body, 3000, 5000) end,
    hurled = function(body) sim.setObjectFloatParam(body, 3001, 1e200) end,
    lost = function(body) sim.setObjectFloatParam(body, 3000, 0 / 0) end,
    spun = function(body) sim.setObjectFloatParam(body, 3020, 1e4) end,
    whirled = function(body) sim.setObjectFloatParam(body, 3020, 1e200) end,
}
local pushes = {
    pushed = {{1e300, 0, 0}, {0, 0, 0}},
    turned = {{0, 0, 0}, {0, 1e300, 0}},
    nowhere = {{0 / 0, 0, 0}, {0, 0, 0}},
    endless = {{1 / 0, 0, 0}, {0, 0, 1 / 0}},
}
local bodies = {}

local function place(name, y)
    local free = watch.box(name, {0, y, 0.05}, true, true)
    watch.box(name .. 'Above', {0, y, 0.15}, true, true)
    local base = watch.box(name .. 'Base', {2, y, 1}, false, false)
    local first, second = watch.box(name .. 'Link', {2.1, y, 1}, true, true), watch.box(name .. 'Tip', {2.3, y, 1}, true, true)
    watch.link(watch.joint(), base, first)
    watch.link(watch.joint(sim.joint_prismatic, sim.jointdynctrl_position), first, second)
    local held = watch.box(name .. 'Held', {4, y, 1}, true, true)
    watch.link(watch.sensor(), watch.box(name .. 'Hook', {4, y, 1.1}, false, false), held)
    return {free, second, held}
end

function sysCall_init()
    local y = 0
    local names = {}
    for name in pairs(oddities) do names[#names + 1] = name end
    for name in pairs(pushes) do names[#names + 1] = name end
    table.sort(names)
    for _, name in ipairs(names) do
        bodies[name] = place(name, y)
        for _, body in ipairs(bodies[name]) do
            if oddities[name] then pcall(oddities[name], body) end
        end
        y = y + 1
    end
    local floor = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {100, 100, 0.1})
    sim.setObjectPosition(floor, {0, 0, -0.05})
    sim.setObjectInt32Param(floor, sim.shapeintparam_respondable, 1)
end

function sysCall_actuation()
    for name, push in pairs(pushes) do
        for _, body in ipairs(bodies[name]) do
            pcall(sim.addForceAndTorque, body, push[1], push[2])
            pcall(sim.addForce, body, push[2], push[1])
        end
    end
end

function sysCall_sensing() watch.check() end

function sysCall_afterSimulation() print('all is well') end
