-- topic: modules
-- as: customization
-- passes: 0
-- loops: 60
-- tol: 1e-6
-- spec: models 5; the conveyors of 4.1, driven by CONVMOV, and conveyor systems
sim = require 'sim'

local function points(n)
    local t = {}
    for i = 1, n do table.move({math.cos(i / 3), 0, math.sin(i / 3), 0, 0, 0, 1}, 1, 7, #t + 1, t) end
    return t
end

local function children(object, type)
    local found, i = {}, 0
    while true do
        local child = sim.getObjectChild(object, i)
        if child < 0 then return found end
        if sim.getObjectType(child) == type then found[#found + 1] = child end
        i = i + 1
    end
end

local function model(poses, options, code)
    local path = sim.createPath(poses, options, 100, 0)
    sim.removeObjects(children(path, sim.sceneobject_script))
    local script = sim.createScript(sim.scripttype_customization, code)
    sim.setObjectParent(script, path)
    sim.initScript(script)
    return path
end

local function count(object, alias)
    local found = 0
    for _, child in ipairs(sim.getObjectsInTree(object)) do
        if sim.getObjectAlias(child) == alias then found = found + 1 end
    end
    return found
end

local function data(object) return sim.unpackTable(sim.readCustomStringData(object, 'CONVMOV')) end

function sysCall_init()
    belt = model(points(18), 2, [[
    conveyor = require('conveyor_customization')
    function sysCall_init()
        conveyor.init{length = 1, padSize = {0.05, 0.2, 0.005}, padCol = {0.2, 0.2, 0.2}, col = {0.5, 0.5, 0.5}, radius = 0.1,
            interPadSpace = 0.002, respondablePads = true, useRollers = false, initPos = 0.1, initVel = 0}
        print(sim ~= nil, path ~= nil, simQHull ~= nil, _S.conveyor == conveyor)
    end
    ]])
    system = model({0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 0, 1}, 0, "conveyorSystem = require('models.conveyorSystem_customization-3')")
    old = model({0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 0, 1}, 0, [[
    conveyorSystem = require('conveyorSystem_customization')
    function sysCall_init()
        conveyorSystem.init{useRollers = true, rollerSize = {0.05, 0.2}, interPadSpace = 0.01, initPos = 0, initVel = 0.2}
    end
    ]])
    print(count(belt, 'pad'), count(old, 'rol'))
end

local passes, steps = 0, 0

function sysCall_nonSimulation()
    passes = passes + 1
    if passes == 3 then
        print('system', count(system, 'pad'), count(system, 'border'), count(system, 'respondable'))
        local last = sim.getObject('./pad', {proxy = system, index = 38})
        print(sim.getObjectPosition(last, system)[1], sim.getObjectPosition(last, system)[3])
        sim.writeCustomStringData(belt, 'CONVMOV', sim.packTable{vel = 0.1})
        sim.startSimulation()
    elseif passes == 4 then
        print('after', data(belt), data(old))
        sim.quitSimulator()
    end
end

function sysCall_sensing()
    steps = steps + 1
    if steps == 4 then
        print(data(belt), data(old).currentPos)
        print(sim.getJointPosition(sim.getObject('./jrol', {proxy = old})))
        sim.writeCustomStringData(belt, 'CONVMOV', sim.packTable{offset = 0.3})
    elseif steps == 8 then
        print(data(belt))
        sim.stopSimulation()
    end
end
