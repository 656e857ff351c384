-- topic: modules
-- as: customization
-- passes: 0
-- loops: 80
-- spec: models 5; conveyors with pads and with rollers carry a box at their velocity
sim = require 'sim'

local VELOCITY <const>, START <const> = 0.2, -0.3
local SHARED <const> = {
    type = 1, width = 0.2, color = {0.2, 0.2, 0.2}, frameColor = {0.5, 0.5, 0.5}, respondable = true, beltElementWidth = 0.05,
    beltElementThickness = 0.005, beltElementSpacing = 0.002, targetVel = VELOCITY, accel = 1,
}
local STRAIGHT <const> = {length = 1, radius = 0.1, rollerCnt = 16}
local SYSTEM <const> = {
    respondableBase = false, closed = false, border = true, respondableBorder = true, borderElementLength = 0.05,
    borderElementHeight = 0.05, borderElementThickness = 0.005, rollerRadius = 0.025, rollerSpacing = 0.01,
}

local function merged(...)
    local all = {}
    for _, part in ipairs{...} do
        for key, value in pairs(part) do all[key] = value end
    end
    return all
end

local function around(count)
    local poses = {}
    for i = 1, count do table.move({math.cos(i / 3), 0, math.sin(i / 3), 0, 0, 0, 1}, 1, 7, #poses + 1, poses) end
    return poses
end

local function scripts(object)
    local found, i = {}, 0
    while true do
        local child = sim.getObjectChild(object, i)
        if child < 0 then return found end
        if sim.getObjectType(child) == sim.sceneobject_script then found[#found + 1] = child end
        i = i + 1
    end
end

local function conveyor(name, config, poses, options, y)
    local path = sim.createPath(poses, options, 100, 0)
    sim.setObjectPosition(path, {0, y, 0.5})
    sim.removeObjects(scripts(path))
    sim.writeCustomTableData(path, '__config__', config)
    local script = sim.createScript(sim.scripttype_customization, "conveyor = require('models." .. name .. "')")
    sim.setObjectParent(script, path)
    sim.initScript(script)
    local box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}, 0)
    sim.setObjectPosition(box, {START, y, 0.555})
    sim.setBoolProperty(box, 'dynamic', true)
    sim.setBoolProperty(box, 'respondable', true)
    sim.setShapeMass(box, 0.5)
    return box
end

local boxes

function sysCall_init()
    local line = {-0.5, 0, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 0, 0, 1}
    boxes = {
        conveyor('conveyor_customization-3', merged(SHARED, STRAIGHT), around(18), 2 | 4, 0),
        conveyor('conveyor_customization-3', merged(SHARED, STRAIGHT, {type = 2, radius = 0.025}), around(18), 2 | 4, 1),
        conveyor('conveyorSystem_customization-3', merged(SHARED, SYSTEM), line, 0, 2),
        conveyor('conveyorSystem_customization-3', merged(SHARED, SYSTEM, {type = 2}), line, 0, 3),
    }
end

local passes, steps = 0, 0

function sysCall_nonSimulation()
    passes = passes + 1
    if passes == 3 then sim.startSimulation() end
end

function sysCall_sensing()
    steps = steps + 1
    if steps ~= 60 then return end
    local way = VELOCITY * (sim.getSimulationTime() + sim.getSimulationTimeStep())
    for i, box in ipairs(boxes) do
        local p = sim.getObjectPosition(box)
        print(i, math.abs(p[1] - START - way) < 0.06, math.abs(p[2] - i + 1) < 0.02, math.abs(p[3] - 0.55) < 0.02)
    end
    sim.quitSimulator()
end
