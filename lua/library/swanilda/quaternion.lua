--[[
Quaternions {x, y, z, w} as plain tables, for the Lua-implemented functions of sim.

Does not know poses or matrices; sim.multiplyPoses and its relatives are native.
]]

local M = {}
local sqrt, acos, sin = math.sqrt, math.acos, math.sin

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] end

function M.inverse(q) return {-q[1], -q[2], -q[3], q[4]} end

--- Angle between two orientations, 0 to pi.
function M.angle(a, b)
    local scale = sqrt(dot(a, a) * dot(b, b))
    if scale == 0 then return 0.0 end
    -- The difference of the vectors is exact for small angles, where acos of the product is not.
    local sign = dot(a, b) < 0 and -1 or 1
    local d = 0
    for i = 1, 4 do d = d + (b[i] - sign * a[i]) ^ 2 end
    return 4 * math.asin(math.min(1, sqrt(d / scale) / 2))
end

--- Orientation at t (0: a, 1: b) on the shortest way.
function M.slerp(a, b, t)
    local cosine, sign = dot(a, b), 1
    if cosine < 0 then cosine, sign = -cosine, -1 end
    local u, v = 1 - t, t
    if cosine < 0.9999995 then
        local angle = acos(cosine)
        u, v = sin(u * angle) / sin(angle), sin(v * angle) / sin(angle)
    end
    local q = {}
    for i = 1, 4 do q[i] = u * a[i] + sign * v * b[i] end
    local norm = sqrt(dot(q, q))
    if norm == 0 then return {0.0, 0.0, 0.0, 1.0} end -- of no orientations at all
    for i = 1, 4 do q[i] = q[i] / norm end
    return q
end

--- Quaternion of the rotation whose columns are the given unit vectors.
function M.fromAxes(x, y, z)
    local trace = x[1] + y[2] + z[3]
    if trace > 0 then
        local s = sqrt(trace + 1) * 2
        return {(y[3] - z[2]) / s, (z[1] - x[3]) / s, (x[2] - y[1]) / s, s / 4}
    elseif x[1] > y[2] and x[1] > z[3] then
        local s = sqrt(1 + x[1] - y[2] - z[3]) * 2
        return {s / 4, (y[1] + x[2]) / s, (z[1] + x[3]) / s, (y[3] - z[2]) / s}
    elseif y[2] > z[3] then
        local s = sqrt(1 + y[2] - x[1] - z[3]) * 2
        return {(y[1] + x[2]) / s, s / 4, (z[2] + y[3]) / s, (z[1] - x[3]) / s}
    end
    local s = sqrt(1 + z[3] - x[1] - y[2]) * 2
    return {(z[1] + x[3]) / s, (z[2] + y[3]) / s, s / 4, (x[2] - y[1]) / s}
end

return M
