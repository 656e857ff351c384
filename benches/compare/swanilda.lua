-- Builds the scene of the table SCENE (see scenes.py), runs it, and prints where the bodies of WATCHED are after every step.
sim = require 'sim'

local handles = {}
local AXIS <const> = {x = {0, math.pi / 2, 0}, y = {-math.pi / 2, 0, 0}, z = {0, 0, 0}}

local function formOf(it)
    return it.round and sim.primitiveshape_spheroid or it.wheel and sim.primitiveshape_cylinder or sim.primitiveshape_cuboid
end

local function shape(it, dynamic)
    local size = it.wheel and {it.size[1], it.size[3], it.size[2]} or it.size
    local handle = sim.createPrimitiveShape(formOf(it), size)
    sim.setObjectPosition(handle, it.at)
    if it.wheel then sim.setObjectOrientation(handle, {math.pi / 2, 0, 0}) end
    sim.setBoolProperty(handle, 'dynamic', dynamic)
    sim.setBoolProperty(handle, 'respondable', SCENE.floor and not it.ghost)
    sim.setObjectInt32Param(handle, sim.shapeintparam_respondable_mask, 0xff00)
    -- Frictions multiply.
    sim.setEngineFloatParam(sim.bullet_body_oldfriction, handle, math.sqrt(SCENE.friction))
    for i, velocity in ipairs{'x', 'y', 'z'} do
        sim.setObjectFloatParam(handle, sim['shapefloatparam_init_velocity_' .. velocity], it.velocity and it.velocity[i] or 0)
    end
    for i, velocity in ipairs{'a', 'b', 'g'} do
        sim.setObjectFloatParam(handle, sim['shapefloatparam_init_velocity_' .. velocity], it.spin and it.spin[i] or 0)
    end
    return handle
end

local function jointOf(it, anchor)
    local joint = it.joint
    if joint.kind == 'weld' then
        local sensor = sim.createForceSensor(0, {0, 1, 10, 0, 0}, {0.02, 100, 10, 0, 0})
        sim.setObjectPosition(sensor, joint.at)
        sim.setObjectParent(sensor, handles[it.parent], true)
        return sensor
    end
    local name = joint.axis[1] == 1 and 'x' or joint.axis[2] == 1 and 'y' or 'z'
    local handle = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(handle, joint.at)
    sim.setObjectOrientation(handle, AXIS[name])
    sim.setObjectParent(handle, it.parent and handles[it.parent] or anchor, true)
    if it.target then
        sim.setIntProperty(handle, 'dynCtrlMode', sim.jointdynctrl_position)
        sim.setJointTargetForce(handle, 200)
        sim.setJointTargetPosition(handle, it.target)
    elseif it.drive then
        sim.setIntProperty(handle, 'dynCtrlMode', sim.jointdynctrl_velocity)
        sim.setJointTargetForce(handle, 200)
        sim.setJointTargetVelocity(handle, it.drive)
    end
    return handle
end

local function tie(first, second, at)
    local dummies = {}
    for i, body in ipairs{first, second} do
        local place = sim.createDummy(0.01)
        sim.setObjectPosition(place, at)
        sim.setObjectParent(place, handles[body], true)
        dummies[i] = place
    end
    -- The closure of dummies is rigid, so the turn of the pivot is left to a joint on the first body.
    local hinge = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(hinge, at)
    sim.setObjectOrientation(hinge, AXIS.y)
    sim.setObjectParent(hinge, handles[first], true)
    sim.setObjectParent(dummies[1], hinge, true)
    for _, place in ipairs(dummies) do
        sim.setObjectInt32Param(place, sim.dummyintparam_dummytype, sim.dummytype_dynloopclosure)
    end
    sim.setLinkDummy(dummies[1], dummies[2])
end

local function build()
    sim.setArrayParam(sim.arrayparam_gravity, SCENE.gravity)
    if SCENE.floor then shape({size = {100, 100, 1}, at = {0, 0, -0.5}}, false) end
    local anchor
    for _, it in ipairs(SCENE.bodies) do
        if it.joint and not anchor then
            anchor = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.01, 0.01, 0.01})
        end
        local handle = shape(it, true)
        if it.joint then sim.setObjectParent(handle, jointOf(it, anchor), true) end
        sim.setShapeMass(handle, it.mass)
        handles[it.name] = handle
    end
    for _, it in ipairs(SCENE.ties) do tie(table.unpack(it)) end
end

local function row()
    local t = {'ROW', string.format('%.3f', sim.getSimulationTime())}
    for _, name in ipairs(WATCHED) do
        local v, w = sim.getVelocity(handles[name])
        for _, part in ipairs{sim.getObjectPose(handles[name]), v, w} do
            for _, x in ipairs(part) do t[#t + 1] = string.format('%.12g', x) end
        end
    end
    print(table.concat(t, ' '))
end

build()

function sysCall_thread()
    sim.setStepping(true)
    local last = SCENE.seconds - 1e-6
    local began = sim.getSystemTime()
    while sim.getSimulationTime() < last do
        sim.step()
        if #WATCHED > 0 then row() end
    end
    print('TOOK ' .. sim.getSystemTime() - began)
    sim.stopSimulation()
end
