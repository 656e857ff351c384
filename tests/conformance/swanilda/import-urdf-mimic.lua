-- spec: import 1
-- as: customization
-- passes: 40
-- Joints that mimic others follow them, at rest and in a dynamic simulation; damping and friction of joints without motors.
sim = require 'sim'
simURDF = require 'simURDF'

local function link(name, mass)
    return ('<link name="%s"><inertial><mass value="%g"/><inertia ixx=".01" ixy="0" ixz="0" iyy=".01" iyz="0" izz=".01"/></inertial></link>'):format(name, mass)
end
local function joint(name, kind, parent, inner)
    return ('<joint name="%s" type="%s"><parent link="%s"/><child link="%s_link"/><axis xyz="0 1 0"/>%s</joint>'):format(name, kind, parent, name, inner)
end
local limit = '<limit lower="-1" upper="1" effort="50" velocity="2"/>'
local gripper = '<?xml version="1.0"?><robot name="gripper"><link name="palm"><collision><geometry><box size=".1 .1 .1"/></geometry></collision></link>'
    .. link('left_link', 0.2) .. link('right_link', 0.2) .. link('tip_link', 0.1)
    .. joint('tip', 'revolute', 'right_link', limit .. '<mimic joint="right" multiplier="-3" offset="0.25"/>')
    .. joint('right', 'prismatic', 'palm', limit .. '<mimic joint="left" multiplier="-1" offset="0.005"/>')
    .. joint('left', 'prismatic', 'palm', limit)
    .. '</robot>'
local function pendulum(dynamics)
    return '<?xml version="1.0"?><robot name="p"><link name="stand"><collision><geometry><box size=".1 .1 .1"/></geometry></collision></link>'
        .. link('hinge_link', 1) .. joint('hinge', 'continuous', 'stand', '<origin rpy="1.5707963 0 0"/>' .. dynamics) .. '</robot>'
end

local function show(label)
    local at = {}
    for i, name in ipairs {'left', 'right', 'tip'} do at[i] = string.format('%.3f', sim.getJointPosition(sim.getObject('/' .. name)) + 0) end
    print(label, table.concat(at, ' '))
end
local function control(dynamics, options)
    local _, roots = simURDF.import(pendulum(dynamics), options)
    local hinge = sim.getObject('/hinge')
    print(sim.getIntProperty(hinge, 'dynCtrlMode'), sim.getJointTargetForce(hinge), table.unpack(sim.getFloatArrayProperty(hinge, 'springDamperParams')))
    sim.removeModel(roots[1])
end

function sysCall_init()
    simURDF.import(gripper, 32)
    for _, name in ipairs {'left', 'right', 'tip'} do
        local handle = sim.getObject('/' .. name)
        local _, offset, factor = sim.getJointDependency(handle)
        print(name, sim.getJointMode(handle), offset, factor)
    end
    show('imported')
    -- The tip's link is where the chain of joints has it, not where all joints are at zero.
    print('right link', string.format('%.3f', sim.getObjectPosition(sim.getObject('/right_link_respondable'))[2]))
    control('<dynamics damping="0.5"/>', 256)
    control('<dynamics friction="0.7"/>', 256)
    control('', 256)
    control('<dynamics damping="0.5"/>', 0)
    sim.setJointTargetPosition(sim.getObject('/left'), 0.03)
end

function sysCall_sensing()
    if sim.getSimulationTime() > 1.9 and not shown then
        shown = true
        show('simulated')
    end
end
