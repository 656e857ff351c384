--[[
Bodies that the cases about dynamics are made of.
]]

local sim = require 'sim'

local M = {}

--- A respondable cuboid, or another primitive; dynamic if `isDynamic`.
function M.box(x, y, z, sx, sy, sz, mass, isDynamic, primitive)
    local h = sim.createPrimitiveShape(primitive or sim.primitiveshape_cuboid, { sx, sy, sz }, 0)
    sim.setObjectPosition(h, { x, y, z })
    sim.setShapeMass(h, mass)
    sim.setObjectInt32Param(h, sim.shapeintparam_static, isDynamic and 0 or 1)
    sim.setObjectInt32Param(h, sim.shapeintparam_respondable, 1)
    return h
end

--- The same, not respondable.
function M.ghost(...)
    local h = M.box(...)
    sim.setObjectInt32Param(h, sim.shapeintparam_respondable, 0)
    return h
end

--- A joint at (0, 0, 1) on a static base, its z axis along +y of the world, with a body of 1 kg: its centre of mass is on the axis, or 0.1 m
--- along +x if there is gravity along -z; `inertia` is that about the axis. Returns joint, body and base.
function M.arm(inertia, gravity)
    sim.setArrayParam(sim.arrayparam_gravity, { 0, 0, -(gravity or 0) })
    local base = M.ghost(0, 0, 1, 0.1, 0.1, 0.1, 1, false)
    local joint = sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPose(joint, sim.buildPose({ 0, 0, 1 }, { -math.pi / 2, 0, 0 }))
    sim.setObjectParent(joint, base, true)
    local x = gravity and 0.1 or 0
    local i = gravity and inertia - 0.01 or inertia
    local body = M.ghost(x, 0, 1, 0.1, 0.1, 0.1, 1, true)
    sim.setShapeInertia(body, { i, 0, 0, 0, i, 0, 0, 0, i }, { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 })
    sim.setObjectParent(body, joint, true)
    return joint, body, base
end

return M
