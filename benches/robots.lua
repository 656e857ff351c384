-- Run by robots.py, which passes `file`, and `positions`: a Lua file with tables {joint = position}, or `base`: 'fixed' or 'free'.
-- Prints lines of tab-separated values.
sim = require 'sim'
simURDF = require 'simURDF'

local function numbers(...)
    local words = {}
    for _, list in ipairs{...} do
        for _, number in ipairs(list) do words[#words + 1] = string.format('%.17g', number) end
    end
    return table.concat(words, ' ')
end

function sysCall_init()
    local positions = sim.getNamedStringParam('positions')
    -- 32: where the file has it, for comparisons; else it stands on the floor.
    local _, roots = simURDF.import(sim.getNamedStringParam('file'), positions and 32 or 0)
    objects, joints, shapes, sensors = {}, {}, {}, {}
    for _, root in ipairs(roots) do
        for _, handle in ipairs(sim.getObjectsInTree(root)) do objects[#objects + 1] = handle end
    end
    for _, handle in ipairs(objects) do
        local kind = sim.getObjectType(handle)
        if kind == sim.sceneobject_shape then
            shapes[#shapes + 1] = handle
        elseif kind == sim.sceneobject_joint and sim.getJointType(handle) ~= sim.joint_spherical then
            joints[#joints + 1] = handle
        end
    end
    if positions then return show_positions(dofile(positions)) end
    if sim.getNamedStringParam('base') == 'fixed' then fix_base() end
    passes, peak, fastest = 0, 0, ''
end

function show_positions(rows)
    for _, handle in ipairs(shapes) do
        if sim.getObjectInt32Param(handle, sim.shapeintparam_static) == 0 then
            local inertia, com = sim.getShapeInertia(handle)
            print('mass\t' .. sim.getObjectAlias(handle) .. '\t' .. numbers({sim.getShapeMass(handle)}, inertia, {com[4], com[8], com[12]}))
        end
    end
    for number, row in ipairs(rows) do
        for _, handle in ipairs(joints) do
            local position = row[sim.getObjectAlias(handle)]
            if position then sim.setJointPosition(handle, position) end
        end
        for _, handle in ipairs(objects) do
            print('pose\t' .. number .. '\t' .. sim.getObjectType(handle) .. '\t' .. sim.getObjectAlias(handle) .. '\t' .. numbers(sim.getObjectPose(handle)))
        end
    end
end

function fix_base()
    for _, handle in ipairs(objects) do
        if sim.getObjectType(handle) == sim.sceneobject_shape and sim.getObjectInt32Param(handle, sim.shapeintparam_static) == 0 then
            sim.setObjectInt32Param(handle, sim.shapeintparam_static, 1)
            return
        end
    end
end

function sysCall_sensing()
    passes = (passes or 0) + 1
    for _, handle in ipairs(shapes) do
        local v = sim.getObjectVelocity(handle)
        local speed = math.sqrt(v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2)
        if not (speed <= peak) then peak, fastest = speed, sim.getObjectAlias(handle) end
    end
end


function sysCall_afterSimulation()
    print(string.format('end\t%d\t%.17g\t%s', passes, peak, fastest))
end

function sysCall_beforeSimulation()
    last = {}
end

function sysCall_actuation()
    for _, handle in ipairs(joints) do
        last[handle] = {sim.getJointPosition(handle) - sim.getJointTargetPosition(handle), sim.getJointForce(handle) or 0}
    end
    if sim.getSimulationTime() > 4.9 and not printed then
        printed = true
        for handle, state in pairs(last) do
            print(string.format('joint\t%s\t%.17g\t%.17g\t%.17g', sim.getObjectAlias(handle), state[1], state[2], sim.getJointTargetForce(handle)))
        end
    end
end
