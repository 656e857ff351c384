-- as: simulation
-- passes: 4
-- engine: bullet278
-- spec: callbacks 5, scripts 6; sysCall_jointCallback, sysCall_contactCallback and sysCall_dynCallback, beside the new names
-- tol: 1e-5
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

-- A joint whose own script answers by the old name (`answer`), and one above it that would by the new name.
local function driven(x, answer)
    local base, child = body(x, 1, false), body(x, 1, true)
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(joint, {x, 0, 1})
    sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, sim.jointdynctrl_callback)
    sim.setObjectParent(joint, base, true)
    sim.setObjectParent(child, joint, true)
    local function attach(object, code)
        local script = sim.createScript(sim.scripttype_simulation, "sim = require 'sim' " .. code, 0, 'lua')
        sim.setObjectParent(script, object, false)
        sim.initScript(script)
    end
    attach(joint, 'function sysCall_jointCallback(data) ' .. answer .. ' end')
    attach(base, 'function sysCall_joint(data) return {velocity = 2, force = 100} end')
    return joint
end

local counts = {old = 0, new = 0, contacts = 0}

function sysCall_init()
    sim.setArrayParam(sim.arrayparam_gravity, {0, 0, 0})
    answered, passedOn = driven(0, 'return {velocity = data.passCnt / 10, force = 100}'), driven(1, '')
    body(3, 0, false, true)
    through, held = body(3, 0.11, true, true), body(3.5, 0.11, true, true)
    body(3.5, 0, false, true)
    for _, shape in ipairs{through, held} do sim.setObjectFloatParam(shape, sim.shapefloatparam_init_velocity_z, -1) end
end

function sysCall_dynCallback(data)
    assert(data.dynStepSize == data.dt and data.totalPasses == 10 and type(data.afterStep) == 'boolean')
    counts.old = counts.old + 1
end

function sysCall_dyn(data) counts.new = counts.new + 1 end

function sysCall_contactCallback(data)
    counts.contacts = counts.contacts + 1
    if data.handle1 == through or data.handle2 == through then return {ignoreContact = false, collisionResponse = false} end
end

local steps = 0

function sysCall_sensing()
    steps = steps + 1
    if steps ~= 2 then return end
    print('angle of the first', sim.getJointPosition(answered))
    print('angle of the second', sim.getJointPosition(passedOn))
    print('sub-steps', counts.old, counts.new)
    print('asked about contacts', counts.contacts > 0)
    print('through', sim.getObjectPosition(through)[3] < 0.05, 'held', sim.getObjectPosition(held)[3] > 0.09)
end
