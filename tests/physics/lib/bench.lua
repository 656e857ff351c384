--[[
What the physics cases share: bodies and joints in a few words, and `check`, which compares a measured quantity with its closed form.

A case is a Lua file that returns nothing and ends with `bench.run(function() ... end)`: what is in there runs in a thread with the
simulation, one `sim.step()` at a time. Metres, kilograms, seconds, radians.
]]

sim = require 'sim'

local M = {}

M.g = -sim.getArrayParam(sim.arrayparam_gravity)[3] -- a float of 32 bits, so not quite 9.81

-- Orientations that make a joint's axis one of the world's.
local ALONG <const> = {x = {0, math.pi / 2, 0}, y = {-math.pi / 2, 0, 0}, z = {0, 0, 0}}

--- A shape: kind, size, at, turn, mass, inertia (diagonal, kg m2), fixed, solid (collides), friction, bounce, mask, parent.
function M.body(it)
    local body = sim.createPrimitiveShape(it.kind or sim.primitiveshape_cuboid, it.size or {0.1, 0.1, 0.1})
    sim.setObjectPosition(body, it.at or {0, 0, 0})
    sim.setObjectOrientation(body, it.turn or {0, 0, 0})
    if it.mass then sim.setShapeMass(body, it.mass) end
    if it.inertia then
        local i = it.inertia
        sim.setShapeInertia(body, {i[1], 0, 0, 0, i[2], 0, 0, 0, i[3]}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0})
    end
    if it.parent then sim.setObjectParent(body, it.parent, true) end
    sim.setBoolProperty(body, 'dynamic', not it.fixed)
    sim.setBoolProperty(body, 'respondable', it.solid or false)
    if it.mask then sim.setIntProperty(body, 'respondableMask', it.mask) end
    sim.setEngineFloatParam(sim.bullet_body_oldfriction, body, it.friction or 0)
    sim.setEngineFloatParam(sim.bullet_body_restitution, body, it.bounce or 0)
    return body
end

--- A joint in dynamic mode: type, at, axis (x, y, z), turn, parent, mode (of control), force, interval {low, high}.
function M.joint(it)
    local joint = sim.createJoint(it.type or sim.joint_revolute, sim.jointmode_dynamic, 0)
    sim.setObjectPosition(joint, it.at or {0, 0, 0})
    sim.setObjectOrientation(joint, it.turn or ALONG[it.axis or 'y'])
    if it.parent then sim.setObjectParent(joint, it.parent, true) end
    if it.interval then sim.setJointInterval(joint, false, {it.interval[1], it.interval[2] - it.interval[1]}) end
    if it.mode then sim.setIntProperty(joint, 'dynCtrlMode', it.mode) end
    if it.force then sim.setJointTargetForce(joint, it.force) end
    return joint
end

--- The ground, its top at z = 0.
function M.ground(friction, bounce)
    return M.body{size = {100, 100, 0.2}, at = {0, 0, -0.1}, fixed = true, solid = true, friction = friction, bounce = bounce}
end

function M.gravity(z) sim.setArrayParam(sim.arrayparam_gravity, {0, 0, z}) end

function M.steps(n) for _ = 1, n do sim.step() end end

--- Steps until `seconds` have passed since the start.
function M.untilTime(seconds)
    while sim.getSimulationTime() < seconds - 1e-6 do sim.step() end
end

--- Kinetic and potential energy of a body, joules.
function M.energy(body)
    local v, w = sim.getVelocity(body)
    local mass, inertia = sim.getShapeMass(body), sim.getShapeInertia(body)
    local m = sim.getObjectMatrix(body)
    local own, e = {}, mass * M.g * m[12]
    for k = 1, 3 do own[k] = m[k] * w[1] + m[4 + k] * w[2] + m[8 + k] * w[3] end
    for i = 1, 3 do
        e = e + mass * v[i] ^ 2 / 2
        for j = 1, 3 do e = e + own[i] * inertia[3 * i + j - 3] * own[j] / 2 end
    end
    return e
end

--- Tells the runner a result: what was measured, what theory says, how far apart the two may be.
function M.check(what, measured, expected, tolerance)
    print(string.format('CHECK\t%s\t%.9g\t%.9g\t%.3g', what, measured, expected, tolerance))
end

--- Runs a case in a thread, then ends the simulation.
function M.run(case)
    function sysCall_thread()
        sim.setStepping(true)
        case()
        sim.stopSimulation()
    end
end

return M
