--[[
Puts objects that measure onto links of a robot. Internal.

Frames of Gazebo's sensors look along x, with z up. Vision sensors look along their z, with y up; optical frames along z, with y down.
]]

local sim = require('sim')

local M = {}

local HIDDEN <const> = 0x2000 -- a layer that is not shown

M.AHEAD = {0, 0, 0, 0, 0, 0, 1}
--- From the frame of a sensor to that of a vision sensor.
M.VISION = {0, 0, 0, 0.5, 0.5, 0.5, 0.5}
--- From the frame of a sensor to that of optics.
M.OPTICAL = {0, 0, 0, -0.5, 0.5, -0.5, 0.5}

--- A pose of x, y, z, roll, pitch, yaw.
function M.pose(numbers)
    if not numbers then return {table.unpack(M.AHEAD)} end
    local x, y, z, roll, pitch, yaw = table.unpack(numbers)
    local cr, sr, cp, sp, cy, sy = math.cos(roll / 2), math.sin(roll / 2), math.cos(pitch / 2), math.sin(pitch / 2), math.cos(yaw / 2), math.sin(yaw / 2)
    return {x, y, z, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy}
end

--- Puts an object onto the link of a part, turned from the frame of the sensor. Returns the sensor's pose in the link's frame.
function M.on(robot, part, object, turn)
    local found, carrier, link = pcall(robot.body.link, part.values.link)
    if not found then
        sim.removeObjects({object})
        error(carrier, 0)
    end
    local pose = M.pose(part.values.pose)
    sim.setObjectAlias(object, part.name)
    sim.setObjectPose(object, sim.multiplyPoses(sim.multiplyPoses(link, pose), turn))
    sim.setObjectParent(object, carrier, true)
    sim.setObjectInt32Param(object, sim.objintparam_visibility_layer, HIDDEN)
    return pose
end

--- A number of a normal distribution around zero.
function M.noise(deviation)
    if deviation == 0 then return 0 end
    return deviation * math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
end

return M
