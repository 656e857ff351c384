-- topic: events
-- as: customization
-- passes: 0
-- loops: 30
-- note: a snapshot to which the events of a run are applied is the snapshot at its end: every change is told
sim = require 'sim'
cbor = require 'org.conman.cbor'
local told, idle, steps, joint, camera = nil, 0, 0, nil, nil

local function apply(bytes, world)
    for _, e in ipairs((cbor.decode(tostring(bytes)))) do
        if e.event == 'objectAdded' then world[e.uid] = e.data
        elseif e.event == 'objectRemoved' then world[e.uid] = nil
        elseif e.event == 'objectChanged' then
            world[e.uid] = world[e.uid] or {}
            for key, value in pairs(e.data) do world[e.uid][key] = value end
        end
    end
    return world
end

local function compare(when)
    local differences, now = {}, apply(sim.getGenesisEvents(), {})
    local function differ(...) differences[#differences + 1] = table.concat({...}, ' ') end
    for uid, data in pairs(now) do
        local name = (data.objectType or uid) .. ' ' .. (data.alias or '')
        local before = told[uid]
        if not before then differ(name, 'is new') end
        for key, value in pairs(before and data or {}) do
            if sim.packTable({value}) ~= sim.packTable({before[key]}) then differ(name, key) end
        end
    end
    for uid in pairs(told) do if not now[uid] then differ(uid, 'is gone') end end
    table.sort(differences)
    print(when, #differences, table.concat(differences, '; '))
end

function sysCall_event(bytes) if told then apply(bytes, told) end end

-- What must stay as it is for this script to go on.
local kept = {alias = 1, ['model.scriptsNotActive'] = 1, ['model.propertyFlags'] = 1, execPriority = 1, restartOnError = 1, scenePath = 1,
    code = 1, scriptDisabled = 1, protocolVersion = 1, sceneIsLocked = 1, pauseSimulationAtError = 1, realtimeSimulation = 1, pauseSimulationAtTime = 1, dynamicsEnabled = 1, timeStep = 1, dynamicsStepSize = 1}

local function other(value)
    if type(value) == 'boolean' then return not value end
    if math.type(value) == 'integer' then return value + 1 end
    if type(value) == 'number' then return value * 1.5 + 0.125 end
    if type(value) == 'string' then return value .. 'x' end
    local list = {}
    for i, number in ipairs(value) do list[i] = other(number) end
    return list
end

local function change_everything(target)
    local names = {}
    for name, info in pairs(sim.getPropertiesInfos(target)) do
        local plain = not name:find('^customData') and not name:find('^namedParam') and not name:find('erbosity')
        if info.flags.value & 3 == 0 and info.type ~= sim.propertytype_buffer and plain and not kept[name] then names[#names + 1] = name end
    end
    table.sort(names)
    for _, name in ipairs(names) do pcall(function() sim.setProperty(target, name, other(sim.getProperty(target, name))) end) end
end

local function change()
    local cube = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1}, 0)
    local dummy = sim.createDummy(0.1)
    local copied = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.createJoint(sim.joint_spherical, sim.jointmode_dynamic, 0)
    sim.createScript(sim.scripttype_customization, 'x = 1', 0, 'lua')
    local sensor = sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.1, 1, 1, 0, 0})
    camera = sim.createVisionSensor(0, {64, 64, 0, 0}, {0.01, 1, 1, 0.1, 0, 0, 0, 0, 0, 0, 0})
    sim.createPointCloud(0.1, 10, 0, 4)
    for _, handle in ipairs(sim.getObjectsInTree(sim.handle_scene)) do change_everything(handle) end
    for _, mesh in ipairs(sim.getIntArrayProperty(cube, 'meshes')) do change_everything(mesh) end
    for _, target in ipairs{sim.handle_scene, sim.handle_app, sim.handle_sandbox, sim.handle_mainscript} do change_everything(target) end
    sim.setObjectParent(copied, cube, false)
    sim.removeObjects({sensor})
    sim.copyPasteObjects({cube, copied}, 0)
    sim.setObjectSel({dummy, cube})
    for _, target in ipairs{dummy, sim.handle_scene, sim.handle_app} do
        sim.setIntProperty(target, 'customData.i', 5)
        sim.setTableProperty(target, 'signal.t', {1, {a = 2}})
    end
    sim.setStringProperty(sim.handle_app, 'namedParam.x', 'y')
    sim.groupShapes({sim.createPrimitiveShape(sim.primitiveshape_cuboid, {1, 1, 1}, 0), sim.createPrimitiveShape(sim.primitiveshape_spheroid, {1, 1, 1}, 0)})
end

local function build()
    local function body(x, z, parent)
        local handle = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}, 0)
        sim.setObjectParent(handle, parent, false)
        sim.setObjectPosition(handle, {x, 5, z})
        sim.setBoolProperty(handle, 'dynamic', parent ~= -1 or z > 1)
        return handle
    end
    body(0, 2, -1)
    local base = body(1, 0.1, -1)
    local motor = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    local sensor = sim.createForceSensor(0, {0, 1, 1, 0, 0}, {0.1, 1, 1, 0, 0})
    for _, handle in ipairs{motor, sensor} do
        sim.setObjectParent(handle, base, false)
        sim.setObjectPosition(handle, {1, 5, 0.2})
        body(1.1, 0.2, handle)
    end
    sim.setFloatProperty(motor, 'targetVel', 1.0)
    joint = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
    sim.removeObjects({camera})
end

function sysCall_nonSimulation()
    idle = idle + 1
    if idle == 2 then told = apply(sim.getGenesisEvents(), {}) end
    if idle == 3 then change() compare('at once') end
    if idle == 4 then compare('a pass later') end
    if idle == 5 then build() sim.startSimulation() end
end

function sysCall_sensing()
    steps = steps + 1
    if steps == 2 then sim.setJointTargetPosition(joint, 0.3) sim.createDummy(0.1) end
    if steps % 5 == 0 then compare(steps) end
    if steps == 15 then sim.stopSimulation() end
end

function sysCall_afterSimulation() compare('after the run') end
