--[[
Messages of points: `sensor_msgs/PointCloud2`. Internal.
]]

local M = {}

local FLOAT32 <const> = 7

local function field(name, offset) return {name = name, offset = offset, datatype = FLOAT32, count = 1} end

--- The message of points, x, y and z of which are 32-bit floats, and maybe a colour. `width` is that of a picture, nil for points without an order.
function M.message(header, data, width, hasColors)
    local fields = {field('x', 0), field('y', 4), field('z', 8)}
    if hasColors then fields[4] = field('rgb', 12) end
    local size = 4 * #fields
    local count = #data // size
    width = width or count
    local message = {
        header = header, height = width > 0 and count // width or 1, width = width, fields = fields, is_bigendian = false,
        point_step = size, row_step = size * width, is_dense = false,
    }
    -- No bytes at all are the default, and simROS2 refuses an empty string.
    if count > 0 then message.data = data end
    return message
end

return M
