-- as: simulation
-- passes: 6
-- engine: bullet278
-- spec: dynamics 2, dynamics 4, dynamics 9, joints 6, joints 7; every field of sysCall_dyn, sysCall_joint, sysCall_contact, what they return, getContactInfo
-- tol: 1e-4
-- topic: dynamics
sim = require 'sim'

local function body(x, z, dynamic, solid)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, 0, z})
    sim.setShapeMass(shape, 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, solid and 1 or 0)
    return shape
end

local function keys(data)
    local names = {}
    for name in pairs(data) do names[#names + 1] = name end
    table.sort(names)
    return table.concat(names, ' ')
end

local function values(data, ...)
    local t = {}
    for i, name in ipairs{...} do
        local value = data[name]
        local text = type(value) == 'number' and string.format('%.4f', value + 0.0):gsub('^-(0%.0+)$', '%1') or tostring(value)
        t[i] = name .. ' ' .. text
    end
    return table.concat(t, ', ')
end

-- A joint with axis up between a base and a box of 1/600 kg m2, driven by this script.
local answers, joints = {}, {}
local function driven(name, x, answer)
    local base, child = body(x, 1, false), body(x, 1, true)
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectAlias(joint, name)
    sim.setObjectPosition(joint, {x, 0, 1})
    sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_callback)
    sim.setObjectParent(base, root, true)
    sim.setObjectParent(joint, base, true)
    sim.setObjectParent(child, joint, true)
    joints[#joints + 1], answers[joint] = joint, answer
    return joint
end

local contacts = {}
function sysCall_init()
    sim.setArrayParam(sim.arrayparam_gravity, {0, 0, 0})
    root = sim.createDummy(0.01) -- scripts are asked about the joints below the object they are attached to
    sim.setObjectParent(sim.getObject('.'), root, true)
    local first = driven('nothing', 0, {})
    sim.setJointInterval(first, false, {-1, 3})
    sim.setJointTargetPosition(first, 0.5)
    sim.setObjectFloatParam(first, sim.jointfloatparam_maxvel or 2036, 1.5)
    driven('force', 1, {force = 0.01})
    driven('ctrl', 2, {ctrl = -0.01})
    driven('velocity', 3, {velocity = 2})
    driven('vel', 4, {vel = -2})
    driven('both', 5, {velocity = 1, force = 0.01})
    driven('numbers only', 6, {velocity = 'fast', force = {}})

    cart = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
    sim.setJointTargetVelocity(cart, 0.2, {1, 10})
    cart2 = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
    sim.setJointTargetPosition(cart2, 0.4, {0.5, 1, 10})
    for _, joint in ipairs{cart, cart2} do sim.setObjectParent(joint, root, true) end

    for i = 0, 3 do
        local floor, box = body(10 + i, 0, false, true), body(10 + i, 0.11, true, true)
        sim.setObjectFloatParam(box, sim.shapefloatparam_init_velocity_z, -1)
        contacts[i] = {floor = floor, box = box}
    end
end

local told = {}
local function once(what) local first = not told[what] told[what] = true return first end

function sysCall_dyn(data)
    if data.passCnt == 1 and once(data.afterStep) or data.passCnt == data.totalPasses and once({}) and once(tostring(data.afterStep)) then
        print('dyn', keys(data), '|', values(data, 'passCnt', 'totalPasses', 'dt', 'dynStepSize', 'afterStep'))
    end
end

function sysCall_joint(data)
    local name = data.handle == cart and 'cart' or data.handle == cart2 and 'cart2' or sim.getObjectAlias(data.handle)
    if data.mode == sim.jointmode_kinematic then
        if once(name) then
            print(name, keys(data))
            print('', values(data, 'mode', 'revolute', 'cyclic', 'lowLimit', 'highLimit', 'pos', 'vel', 'targetPos', 'targetVel', 'error', 'maxVel',
                'maxAccel', 'maxJerk'))
        end
        return {position = data.currentPos + 0.01, velocity = 0.2, immobile = name == 'cart' and data.pos > 0.015}
    end
    if name == 'nothing' and (once('a') or data.passCnt == 2 and once('b')) then
        if data.passCnt == 1 then print(keys(data)) end
        print('', values(data, 'mode', 'first', 'revolute', 'cyclic', 'lowLimit', 'highLimit', 'passCnt', 'totalPasses', 'pos', 'currentPos', 'vel',
            'currentVel', 'targetPos', 'error', 'errorValue', 'effort', 'dt', 'dynStepSize', 'targetVel', 'force', 'maxForce', 'maxVel',
            'velUpperLimit', 'maxAccel', 'maxJerk'))
    end
    return answers[data.handle]
end

function sysCall_contact(data)
    if once('contact') then print('contact', keys(data), data.engine) end
    local function meets(i) return data.handle1 == contacts[i].box or data.handle2 == contacts[i].box end
    if meets(1) then return {ignoreContact = false} end
    if meets(2) then return {ignoreContact = false, collisionResponse = true, bullet = {friction = 0, restitution = 1}} end
    if meets(3) then return {ignoreContact = true, collisionResponse = false} end
end

local function info(...)
    local handles, point, force, normal = sim.getContactInfo(...)
    if #handles == 0 then return #handles, #point, #force, #normal end
    local box = handles[1] == contacts[0].box and 'box' or handles[1] == contacts[0].floor and 'floor' or 'other'
    return box, force[3] * normal[3] >= 0, string.format('%.3f', normal[3]), #point
end

local steps = 0
function sysCall_sensing()
    steps = steps + 1
    if steps == 1 then
        -- 0.01 N m on 1/600 kg m2 for 0.05 s: 0.3 rad/s.
        for _, joint in ipairs(joints) do print(sim.getObjectAlias(joint), string.format('%.4f', sim.getJointVelocity(joint) + 1e-12)) end
        print('pushes back', info(sim.handle_all, contacts[0].box, 0))
        print('the other way', info(sim.handle_all, contacts[0].floor, 0))
        print('behind the last', info(sim.handle_all, contacts[0].box, 9999))
        print('of no pass', info(9999, contacts[0].box, 0))
        print('of nobody', info(sim.handle_all, joints[1], 0))
        print(pcall(sim.getContactInfo, sim.handle_all, 99999, 0))
        print(pcall(sim.getContactInfo, sim.handle_all, sim.handle_all, -1))
    elseif steps == 5 then
        for i = 0, 3 do print(i, string.format("%.0f", sim.getVelocity(contacts[i].box)[3] + 1e-3)) end
        print(sim.getJointPosition(cart), sim.getJointPosition(cart2))
    end
end
