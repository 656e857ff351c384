-- as: simulation
-- passes: 14
-- engine: bullet278
-- spec: joints 7, joints 7.1; joint force is the mean over the sub-steps and the negative of the effort along +z; raw value; turns of cyclic and other joints; screw in the dynamics; interval of a spherical joint
-- tol: 1e-5
-- topic: dynjoints
sim = require 'sim'

local function ghost(x, y, z, mass, dynamic)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(shape, {x, y, z})
    sim.setShapeMass(shape, mass)
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, dynamic and 0 or 1)
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 0)
    return shape
end

-- A body on a joint whose axis points upwards, `x` metres from the origin.
local function hang(x, kind, control, reach)
    local joint = sim.createJoint(kind, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(joint, {x, 0, 1})
    sim.setObjectParent(joint, ghost(x, 0, 1, 1, false), true)
    if control then sim.setObjectInt32Param(joint, sim.jointintparam_dynctrlmode, control) end
    local body = ghost(x + (reach or 0), 0, 1, 2, true)
    sim.setObjectParent(body, joint, true)
    return joint, body
end

function sysCall_init()
    asked = hang(0, sim.joint_prismatic, sim.jointdynctrl_callback)
    local code = [[sim = require 'sim' function sysCall_joint(data) return {force = 19.62 + data.passCnt} end]]
    local script = sim.createScript(sim.scripttype_simulation, code, 0, 'lua')
    sim.setObjectParent(script, asked, false)
    sim.initScript(script)
    sim.setJointInterval(asked, false, {-100, 200})
    cyclic, counted = hang(1, sim.joint_revolute, sim.jointdynctrl_velocity), hang(2, sim.joint_revolute, sim.jointdynctrl_velocity)
    sim.setJointInterval(counted, false, {-100, 200})
    for _, joint in ipairs{cyclic, counted} do sim.setJointTargetVelocity(joint, 8) sim.setJointTargetForce(joint, 1000) end
    screw, nut = hang(3, sim.joint_revolute, sim.jointdynctrl_velocity)
    sim.setJointInterval(screw, false, {-100, 200})
    -- Only outside of the dynamics can a lead be set; it stays.
    sim.setObjectFloatParam(screw, sim.jointfloatparam_screwlead, 0.05)
    print('lead in the dynamics', sim.getObjectFloatParam(screw, sim.jointfloatparam_screwlead))
    sim.setJointMode(screw, sim.jointmode_kinematic, 0)
    sim.setObjectFloatParam(screw, sim.jointfloatparam_screwlead, 0.05)
    sim.setJointMode(screw, sim.jointmode_dynamic, 0)
    sim.setObjectInt32Param(screw, sim.jointintparam_dynctrlmode, sim.jointdynctrl_velocity)
    sim.setJointTargetForce(screw, 1000)
    sim.setJointTargetVelocity(screw, 2 * math.pi)
    ball, swung = hang(4, sim.joint_spherical, nil, 0.3)
    sim.setJointInterval(ball, false, {0, 0.1})
    free = hang(5, sim.joint_revolute)
end

local steps = 0

function sysCall_dyn(data)
    if steps == 2 and data.afterStep and data.passCnt == 4 then
        print('in the fourth sub-step', sim.getJointForce(asked | sim.handleflag_rawvalue))
    end
end

function sysCall_actuation() steps = steps + 1 end

function sysCall_sensing()
    if steps == 2 then print('mean', sim.getJointForce(asked)) end
    if steps ~= 10 then return end
    print('turns', sim.getJointPosition(cyclic), sim.getJointPosition(counted), sim.getJointVelocity(cyclic), sim.getJointVelocity(counted))
    print('screw', sim.getJointPosition(screw), sim.getObjectPosition(nut)[3], sim.getObjectChildPose(screw)[3])
    -- Lead over a turn times the weight.
    print('its effort', sim.getJointForce(screw), 'free', sim.getJointForce(free))
    local p = sim.getObjectPosition(swung)
    print('swings beyond its interval', p[3] < 0.9, 'length', math.sqrt((p[1] - 4) ^ 2 + p[2] ^ 2 + (p[3] - 1) ^ 2))
end
