-- A ball that falls onto a floor, a wall, and a place with a name.
sim = require 'sim'

local function shape(kind, name, size, position, isStatic)
    local handle = sim.createPrimitiveShape(kind, size, 0)
    sim.setObjectAlias(handle, name)
    sim.setObjectPosition(handle, position)
    sim.setObjectInt32Param(handle, sim.shapeintparam_static, isStatic and 1 or 0)
    sim.setObjectInt32Param(handle, sim.shapeintparam_respondable, 1)
end

function sysCall_init()
    local simROS2 = require 'simROS2'
    simROS2.setParamDouble('arm.gain', 2.5)
    simROS2.setParamString('arm.name', 'left')
    simROS2.setParamBool('debug', true)
    simROS2.log(sim.verbosity_scriptwarnings, 'the arm is there')
    if sim.getObject('/Ball', { noError = true }) ~= -1 then return end
    shape(sim.primitiveshape_cuboid, 'Floor', { 20, 20, 0.1 }, { 0, 0, -0.05 }, true)
    shape(sim.primitiveshape_cuboid, 'Wall', { 0.1, 1, 0.5 }, { 2, 0, 0.25 }, true)
    shape(sim.primitiveshape_spheroid, 'Ball', { 0.2, 0.2, 0.2 }, { 0, 0, 4 }, false)
    local dock = sim.createDummy(0.05)
    sim.setObjectAlias(dock, 'Dock')
    sim.setObjectPosition(dock, { 7, 0, 0 })
end
