-- Builds the hand and the object of the table CASE (see grasp_scenes.py), moves the hand, and prints where the object is in it.
sim = require 'sim'

local SUBSTEPS <const>, CLOSING_SPEED <const> = 10, 0.05
local object, palm, base, drivers = nil, nil, nil, {}
local count, peak, before = 0, 0, {0, 0, 0}

local function collide(shape, mask)
    sim.setBoolProperty(shape, 'respondable', mask ~= 0)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable_mask, mask)
    -- Frictions multiply.
    sim.setEngineFloatParam(sim.bullet_body_oldfriction, shape, math.sqrt(CASE.friction))
    sim.setEngineFloatParam(sim.bullet_body_restitution, shape, 0)
end

local function ghost(size, at, mass)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectPosition(shape, at)
    collide(shape, 0)
    sim.setBoolProperty(shape, 'dynamic', mass > 0)
    if mass > 0 then sim.setShapeMass(shape, mass) end
    return shape
end

local KINDS <const> = {box = sim.primitiveshape_cuboid, ball = sim.primitiveshape_spheroid, cylinder = sim.primitiveshape_cylinder}

local function solid(part)
    local shape
    if part.kind == 'mesh' then
        local vertices, indices = {}, {}
        for _, point in ipairs(part.vertices) do for i = 1, 3 do vertices[#vertices + 1] = point[i] end end
        for _, face in ipairs(part.faces) do for i = 1, 3 do indices[#indices + 1] = face[i] end end
        shape = sim.createShape(0, 0, vertices, indices)
    else
        shape = sim.createPrimitiveShape(KINDS[part.kind], part.size)
    end
    sim.setObjectPosition(shape, part.at)
    sim.setObjectOrientation(shape, {0, 0, part.yaw})
    return shape
end

local function makeObject()
    local shapes = {}
    for i, part in ipairs(CASE.object.parts) do shapes[i] = solid(part) end
    object = #shapes > 1 and sim.groupShapes(shapes) or shapes[1]
    sim.relocateShapeFrame(object, {0, 0, 0, 0, 0, 0, 1})
    local i = CASE.object.inertia
    sim.setShapeMass(object, CASE.object.mass)
    sim.setShapeInertia(object, {i[1], 0, 0, 0, i[2], 0, 0, 0, i[3]}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})
    collide(object, 0xffff)
    sim.setBoolProperty(object, 'dynamic', true)
end

local function joint(kind, parent, orientation, mode, force)
    local handle = sim.createJoint(kind, sim.jointmode_dynamic, 0)
    sim.setObjectOrientation(handle, orientation)
    sim.setObjectParent(handle, parent, true)
    sim.setIntProperty(handle, 'dynCtrlMode', mode)
    sim.setJointTargetForce(handle, force)
    if kind == sim.joint_prismatic then sim.setJointInterval(handle, false, {-1, 2}) end
    return handle
end

local AXES <const> = {{0, math.pi / 2, 0}, {-math.pi / 2, 0, 0}, {0, 0, 0}}

local function makeBase()
    local last = ghost({0.1, 0.1, 0.02}, {0, 0, 0.15}, 0)
    base = {}
    if CASE.moving then
        for i, axis in ipairs{1, 2, 3, 1, 2} do
            local kind = i <= 3 and sim.joint_prismatic or sim.joint_revolute
            base[i] = joint(kind, last, AXES[axis], sim.jointdynctrl_velocity, 1e4)
            last = ghost({0.06, 0.06, 0.06}, {0, 0, 0.1}, 1)
            sim.setObjectParent(last, base[i], true)
        end
    end
    palm = sim.createDummy(0.01)
    sim.setObjectParent(palm, last, true)
    return last
end

local function makeFinger(it, parent)
    -- The slide's z axis is `inward`, level.
    local handle = joint(sim.joint_prismatic, parent, {0, 0, 0}, sim.jointdynctrl_velocity, it.force)
    sim.setObjectPosition(handle, it.at)
    local x, y = it.inward[1], it.inward[2]
    sim.setObjectMatrix(handle, {-y, 0, x, it.at[1], x, 0, y, it.at[2], 0, 1, 0, it.at[3]})
    if it.drives then
        sim.setJointTargetVelocity(handle, CLOSING_SPEED)
        drivers[#drivers + 1] = handle
    else
        sim.setIntProperty(handle, 'dynCtrlMode', sim.jointdynctrl_position)
        sim.setJointTargetPosition(handle, 0)
    end
    local pad = sim.createPrimitiveShape(sim.primitiveshape_cuboid, CASE.pad)
    sim.setObjectPosition(pad, it.at)
    sim.setObjectOrientation(pad, {0, 0, it.yaw})
    sim.setShapeMass(pad, CASE.pad_mass)
    sim.setObjectParent(pad, handle, true)
    collide(pad, 0xff00)
    sim.setBoolProperty(pad, 'dynamic', true)
end

local function build()
    makeObject()
    local hand = makeBase()
    for _, it in ipairs(CASE.fingers) do makeFinger(it, hand) end
    if CASE.table then
        local table = ghost({1, 1, 0.1}, {0, 0, CASE.table - 0.05}, 0)
        collide(table, 0xff00)
    end
    sim.setArrayParam(sim.arrayparam_gravity, CASE.gravity[1])
end

local function move(k)
    for _, handle in ipairs(drivers) do sim.setJointTargetForce(handle, CASE.fingers[1].force * CASE.squeeze[k]) end
    sim.setArrayParam(sim.arrayparam_gravity, CASE.gravity[k])
    for i, handle in ipairs(base) do
        local last = k > 1 and CASE.path[k - 1][i] or 0
        sim.setJointTargetVelocity(handle, (CASE.path[k][i] - last) / CASE.step)
    end
end

--- Difference of the object's acceleration to the palm's as it is asked for.
local function measure(k)
    local now, sum = sim.getVelocity(object), 0
    for i = 1, 3 do sum = sum + ((now[i] - before[i]) / CASE.step - CASE.accelerations[k][i]) ^ 2 end
    if k > CASE.start then peak = math.max(peak, math.sqrt(sum)) end
    before = now
end

function sysCall_dyn(data)
    if not data.afterStep then
        count = count + 1
        if count <= #CASE.path then
            move(count)
        elseif count == #CASE.path + 1 then
            for _, handle in ipairs(base) do sim.setJointTargetVelocity(handle, 0) end
        end
    elseif count <= #CASE.path then
        measure(count)
    end
end

local function row()
    local at = sim.getObjectPosition(object, palm)
    print(string.format('ROW %.4f %.12g %.12g %.12g', sim.getSimulationTime(), at[1], at[2], at[3]))
end

local function steps(seconds)
    for _ = 1, math.ceil(seconds / CASE.step / SUBSTEPS - 1e-6) do
        sim.step()
        row()
    end
end

build()

function sysCall_thread()
    sim.setStepping(true)
    steps(#CASE.path * CASE.step)
    local began = sim.getSystemTime()
    steps(CASE.hold)
    print('TOOK ' .. (sim.getSystemTime() - began) / CASE.hold * CASE.step)
    print('PEAK ' .. peak)
    sim.stopSimulation()
end
