-- topic: modules
-- as: customization
-- passes: 0
-- loops: 500
-- tol: 1e-4
-- spec: models 5; a conveyor with pads: where they are, how it is driven; the settings of one with rollers
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

local function conveyor(config)
    local path = sim.createPath(points(18), 2 | 4, 100, 0)
    sim.removeObjects(children(path, sim.sceneobject_script))
    if config then sim.writeCustomTableData(path, '__config__', config) end
    local script = sim.createScript(sim.scripttype_customization, "conveyor = require('models.conveyor_customization-3')")
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

local function state()
    local s = sim.readCustomTableData(belt, '__state__')
    return string.format('%.6f %.6f', s.pos or -1, s.vel or -1)
end

function sysCall_init()
    belt = conveyor()
    rollers = conveyor{type = 2, rollerCnt = 16, targetVel = 0}
    print(sim.readCustomTableData(belt, '__info__').type, sim.readCustomTableData(belt, '__info__').modelType)
end

local passes, steps = 0, 0

local function firstPad()
    local p = sim.getObjectPosition(sim.getObject('./pad', {proxy = belt}), belt)
    return string.format('%.5f %.5f %.5f', p[1], p[2], p[3])
end

function sysCall_nonSimulation()
    passes = passes + 1
    if passes ~= 3 then return end
    local poses = sim.unpackDoubleTable(sim.readCustomStringData(belt, 'PATHCTRLPTS'))
    table.move(poses, 1, 7, #poses + 1)
    local _, total = sim.getPathLengths(poses, 7)
    print('pads', count(belt, 'pad'), total, firstPad())
    print('rollers', count(rollers, 'rol'), count(rollers, 'jrol'), count(rollers, 'pad'))
    local a, b = sim.getObject('./jrol', {proxy = rollers}), sim.getObject('./jrol', {proxy = rollers, index = 1})
    local p, q = sim.getObjectPosition(a, rollers), sim.getObjectPosition(b, rollers)
    print(p[1], p[3], q[1] - p[1])
    print('frame', sim.getObjectAlias(sim.getObject('./shape', {proxy = belt})))
    sim.writeCustomTableData(rollers, '__ctrl__', {pos = 0.2})
    sim.startSimulation()
end

function sysCall_sensing()
    steps = steps + 1
    if steps == 1 or steps == 20 or steps == 200 then print(steps, state()) end
    if steps == 1 then print('ctrl', next(sim.readCustomTableData(rollers, '__ctrl__'))) end
    if steps == 1 then print('forward', firstPad()) end
    if steps == 200 then sim.writeCustomTableData(belt, '__ctrl__', {vel = 0}) end
    if steps == 201 then print('ctrl', next(sim.readCustomTableData(belt, '__ctrl__'))) end
    if steps == 410 then
        print(steps, state())
        local s = sim.readCustomTableData(rollers, '__state__')
        local joint = sim.getJointPosition(sim.getObject('./jrol', {proxy = rollers}))
        print('roller', s.pos, s.vel, joint / s.pos)
        sim.stopSimulation()
    end
end

function sysCall_afterSimulation()
    stopped = true
end

function sysCall_suspended() end

local looked

sysCall_nonSimulation_ = sysCall_nonSimulation
function sysCall_nonSimulation()
    if stopped and not looked then
        looked = true
        print('after', state())
        sim.quitSimulator()
    end
    sysCall_nonSimulation_()
end
