-- The scene of view_browser.py: a box, an arm of two links, hostile names, a script with an error.
sim = require 'sim'

local HOSTILE <const> = '<img src=x onerror=hacked=1>'

local function shape(alias, kind, size, position, colour)
    local handle = sim.createPrimitiveShape(kind, size)
    sim.setObjectAlias(handle, alias)
    sim.setObjectPosition(handle, position)
    sim.setShapeColor(handle, nil, sim.colorcomponent_ambient_diffuse, colour)
    return handle
end

local function joint(position, parent)
    local handle = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0, {0.2, 0.06})
    sim.setObjectAlias(handle, 'joint')
    sim.setObjectPosition(handle, position)
    sim.setObjectParent(handle, parent, true)
    return handle
end

function sysCall_init()
    box = shape('box', sim.primitiveshape_cuboid, {0.4, 0.4, 0.4}, {0.8, 0, 0.2}, {0.9, 0.3, 0.1})
    local base = shape('base', sim.primitiveshape_cylinder, {0.3, 0.3, 0.2}, {0, 0, 0.1}, {0.3, 0.3, 0.35})
    turn = joint({0, 0, 0.25}, base)
    local link = shape('link', sim.primitiveshape_cuboid, {0.6, 0.12, 0.12}, {0.3, 0, 0.36}, {0.2, 0.45, 0.8})
    sim.setObjectParent(link, turn, true)
    sim.setObjectAlias(sim.createDummy(0.05), 'hostile ' .. HOSTILE)
    print(HOSTILE)
    sim.addLog(sim.verbosity_scriptwarnings, 'a warning')
end

function sysCall_actuation()
    sim.setJointPosition(turn, sim.getSimulationTime())
    if sim.getSimulationTime() > 0.3 and not failed then
        failed = true
        error('an error of the test')
    end
end

function sysCall_nonSimulation()
    local selection = table.concat(sim.getObjectSel(), ' ')
    if selection ~= shown then
        shown = selection
        print('selection: ' .. selection)
    end
end
