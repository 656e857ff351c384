--[[
Robots of boxes, with position servos at zero in every joint, standing on the ground. Links of a robot do not collide with each other.
]]

local bench = require 'lib.bench'

local M = {}

--- A robot under construction: its bodies and joints by name.
local Robot = {}
Robot.__index = Robot

function M.robot() return setmetatable({bodies = {}, joints = {}}, Robot) end

--- A body; `more`: kind, friction, and ghost, for one that collides with nothing.
function Robot:body(name, at, size, mass, more)
    more = more or {}
    local body = bench.body{kind = more.kind, size = size, at = at, mass = mass, solid = not more.ghost, friction = more.friction or 1}
    sim.setObjectInt32Param(body, sim.shapeintparam_respondable_mask, 0xff00)
    self.bodies[name] = body
    return body
end

--- A hinge about a world axis between two bodies.
function Robot:hinge(parent, child, at, axis, force)
    local joint = bench.joint{at = at, axis = axis, parent = self.bodies[parent], mode = sim.jointdynctrl_position, force = force}
    sim.setObjectParent(self.bodies[child], joint, true)
    sim.setJointTargetPosition(joint, 0)
    self.joints[#self.joints + 1] = joint
end

--- A force sensor between two bodies.
function Robot:weld(parent, child, at)
    local sensor = sim.createForceSensor(0, {0, 1, 10, 0, 0}, {0.02, 100, 10, 0, 0})
    sim.setObjectPosition(sensor, at)
    sim.setObjectParent(sensor, self.bodies[parent], true)
    sim.setObjectParent(self.bodies[child], sensor, true)
    return sensor
end

--- 58 kg on one foot of `mass`.
function M.one_foot(y, mass)
    local r = M.robot()
    r:body('trunk', {0, y, 0.54}, {0.2, 0.2, 0.6}, 58)
    r:body('foot', {0, y, 0.02}, {0.2, 0.1, 0.04}, mass)
    r.sensor = r:weld('trunk', 'foot', {0, y, 0.04})
    return r
end

--- A trunk of 50 kg on two feet, with ankles of two axes and a link of 0.3 kg between these; its lowest points at `z`.
function M.two_feet(y, z)
    local r = M.robot()
    r:body('trunk', {0, y, z + 0.6}, {0.2, 0.3, 0.8}, 50)
    for side, across in ipairs{y - 0.1, y + 0.1} do
        local foot, link = 'foot' .. side, 'link' .. side
        r:body(foot, {0.03, across, z + 0.025}, {0.22, 0.1, 0.05}, 1)
        r:body(link, {0, across, z + 0.1}, {0.04, 0.04, 0.04}, 0.3, {ghost = true})
        r:hinge('trunk', link, {0, across, z + 0.1}, 'y', 300)
        r:hinge(link, foot, {0, across, z + 0.1}, 'x', 300)
    end
    return r
end

local function leg(r, side, y)
    local function body(name, ...) r:body(name .. side, ...) end
    body('hip yaw', {0, y, 0.89}, {0.05, 0.05, 0.05}, 0.5, {ghost = true})
    r:hinge('pelvis', 'hip yaw' .. side, {0, y, 0.89}, 'z', 300)
    body('hip roll', {0, y, 0.89}, {0.05, 0.05, 0.05}, 0.5, {ghost = true})
    r:hinge('hip yaw' .. side, 'hip roll' .. side, {0, y, 0.89}, 'x', 300)
    body('thigh', {0, y, 0.69}, {0.1, 0.1, 0.36}, 5)
    r:hinge('hip roll' .. side, 'thigh' .. side, {0, y, 0.89}, 'y', 300)
    body('shin', {0, y, 0.3}, {0.08, 0.08, 0.36}, 2.5)
    r:hinge('thigh' .. side, 'shin' .. side, {0, y, 0.5}, 'y', 300)
    body('ankle', {0, y, 0.08}, {0.04, 0.04, 0.04}, 0.3, {ghost = true})
    r:hinge('shin' .. side, 'ankle' .. side, {0, y, 0.08}, 'y', 300)
    body('foot', {0.03, y, 0.02}, {0.24, 0.1, 0.04}, 1)
    r:hinge('ankle' .. side, 'foot' .. side, {0, y, 0.08}, 'x', 300)
end

local function arm(r, side, y)
    r:body('shoulder' .. side, {0, y, 1.32}, {0.05, 0.05, 0.05}, 0.3, {ghost = true})
    r:hinge('torso', 'shoulder' .. side, {0, y, 1.32}, 'y', 100)
    r:body('upper arm' .. side, {0, y, 1.18}, {0.07, 0.07, 0.26}, 2)
    r:hinge('shoulder' .. side, 'upper arm' .. side, {0, y, 1.32}, 'x', 100)
    r:body('fore arm' .. side, {0, y, 0.9}, {0.06, 0.06, 0.26}, 1.5)
    r:hinge('upper arm' .. side, 'fore arm' .. side, {0, y, 1.04}, 'y', 100)
end

--- A humanoid of 62 kg with 20 joints.
function M.humanoid()
    local r = M.robot()
    r:body('pelvis', {0, 0, 0.95}, {0.15, 0.25, 0.12}, 12)
    r:body('torso', {0, 0, 1.2}, {0.15, 0.3, 0.35}, 20)
    r:hinge('pelvis', 'torso', {0, 0, 1.02}, 'z', 300)
    r:body('head', {0, 0, 1.5}, {0.15, 0.15, 0.2}, 4)
    r:hinge('torso', 'head', {0, 0, 1.4}, 'z', 50)
    for side, y in ipairs{-0.1, 0.1} do
        leg(r, side, y)
        arm(r, side, 2 * y)
    end
    return r
end

--- A quadruped of 14 kg with 12 joints on round feet, its knees bent.
function M.quadruped(y)
    local r = M.robot()
    r:body('trunk', {0, y, 0.32}, {0.4, 0.2, 0.1}, 8)
    for number, at in ipairs{{-0.18, -0.13}, {-0.18, 0.13}, {0.18, -0.13}, {0.18, 0.13}} do
        local x, across = at[1], y + at[2]
        r:body('hip' .. number, {x, across, 0.3}, {0.05, 0.05, 0.05}, 0.5, {ghost = true})
        r:hinge('trunk', 'hip' .. number, {x, across, 0.3}, 'x', 40)
        r:body('thigh' .. number, {x - 0.04, across, 0.235}, {0.03, 0.03, 0.13}, 0.8, {ghost = true})
        r:hinge('hip' .. number, 'thigh' .. number, {x, across, 0.3}, 'y', 40)
        r:body('shin' .. number, {x - 0.04, across, 0.1}, {0.03, 0.03, 0.13}, 0.2, {ghost = true})
        r:hinge('thigh' .. number, 'shin' .. number, {x - 0.08, across, 0.17}, 'y', 40)
        r:body('foot' .. number, {x, across, 0.02}, {0.04, 0.04, 0.04}, 0.06, {kind = sim.primitiveshape_spheroid, friction = 0.8})
        r:weld('shin' .. number, 'foot' .. number, {x, across, 0.03})
    end
    return r
end

--- Angle between the z axis of an object and the vertical.
function M.tilt(handle)
    return math.acos(math.max(-1, math.min(1, sim.getObjectMatrix(handle)[11])))
end

return M
