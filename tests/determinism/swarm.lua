-- Thirty-two arms of five joints, some of which push boxes or each other; a line per step with poses and forces, all digits.
sim = require 'sim'

local joints, watched = {}, {}

local function box(at, size, parent)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, size)
    sim.setObjectPosition(shape, at)
    sim.setShapeMass(shape, 0.5)
    if parent then sim.setObjectParent(shape, parent, true) end
    sim.setBoolProperty(shape, 'dynamic', true)
    sim.setBoolProperty(shape, 'respondable', true)
    watched[#watched + 1] = shape
    return shape
end

for arm = 1, 32 do
    local y = 0.25 * arm
    local parent = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.05, 0.05, 0.05})
    sim.setObjectPosition(parent, {0, y, 0.3})
    for i = 1, 5 do
        local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
        sim.setObjectPosition(joint, {0.12 * i - 0.06, y, 0.3})
        sim.setObjectOrientation(joint, i % 2 == 1 and {0, 0, 0} or {-math.pi / 2, 0, 0})
        sim.setObjectParent(joint, parent, true)
        sim.setIntProperty(joint, 'dynCtrlMode', sim.jointdynctrl_position)
        sim.setJointTargetForce(joint, 20)
        joints[#joints + 1] = joint
        parent = box({0.12 * i, y, 0.3}, {0.1, 0.04, 0.04}, joint)
    end
    if arm % 3 == 0 then box({0.5, y + 0.1, 0.06}, {0.1, 0.1, 0.1}) end
end

function sysCall_actuation()
    local t = sim.getSimulationTime()
    for i, joint in ipairs(joints) do sim.setJointTargetPosition(joint, 0.5 * math.sin(2 * t + i)) end
end

function sysCall_sensing()
    local hash = 0
    local function add(numbers)
        for _, number in ipairs(numbers) do
            hash = ((hash << 7 | hash >> 57) ~ string.unpack('<i8', string.pack('<d', number))) * 0x9E3779B97F4A7C15
        end
    end
    for _, shape in ipairs(watched) do add(sim.getObjectPose(shape)) end
    for _, joint in ipairs(joints) do add{sim.getJointForce(joint)} end
    print(string.format('%016x', hash))
end
