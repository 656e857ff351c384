--[[
Paths as flat tables of configurations: lengths, interpolation, resampling; path objects; trajectories in time.

Does not follow a path: that is a loop over sim.getPathInterpolatedConfig in the script.
]]

local sim = ...
local M = {}
local quaternion = require 'swanilda.quaternion'

local LINEAR <const>, CYCLIC <const>, QUATERNION <const> = 0, 1, 2
local END_GAP <const> = 1e-8 -- 4.10 never reaches the end of a path, it stops this much before
local ROUND <const> = 2 * math.pi

-- A tail call: its own frame is gone when checkargs looks for the checked function.
local function check(types, ...) return require('checkargs.check').checkargsEx({level = 0}, types, ...) end

local function wrap(angle)
    if angle >= -math.pi and angle <= math.pi then return angle end -- both ends stay what they are
    return angle - ROUND * math.floor((angle + math.pi) / ROUND)
end

-- Numbers per point; an error where path and lengths cannot belong together.
local function dofOf(path, lengths, level)
    local dof = #path // math.max(1, #lengths)
    if dof < 1 then error('Bad table size.', level + 1) end
    return dof
end

local function config(path, dof, index) return table.move(path, (index - 1) * dof + 1, index * dof, 1, {}) end

local function pointDistance(a, b, dof)
    local sum = 0
    for i = 1, math.min(3, dof) do sum = sum + (b[i] - a[i]) * (b[i] - a[i]) end
    return math.sqrt(sum)
end

local function isCallable(value)
    local meta = type(value) == 'table' and getmetatable(value)
    return type(value) == 'function' or type(meta) == 'table' and meta.__call ~= nil
end

local LENGTHS_ARGS = {{type = 'table', item_type = 'float', size = '2..*'}, {type = 'int'}, {type = 'any', default_nil = true}}

--- Distances along a path, from its start to each of its points.
-- @api float[] lengths, float total = sim.getPathLengths(float[] path, int dof, func distCallback = nil)
-- @param path dof numbers per point
-- @param dof numbers per point
-- @param distCallback function(a, b, dof) giving a distance; default: of the first three coordinates
-- @return lengths as many as there are points
-- @return total the last of them
function M.getPathLengths(...)
    local path, dof, distance = check(LENGTHS_ARGS, ...)
    if type(distance) == 'string' then distance = require('var.functions').getvar(distance) or distance end
    if not (distance == nil or isCallable(distance)) then error('distCallback is not a function.', 2) end
    distance = distance or pointDistance
    local count = dof > 0 and #path // dof or 0
    if count < 2 then error('Bad table size.', 2) end
    local lengths, total = {0}, 0
    for i = 2, count do
        local step = distance(config(path, dof, i - 1), config(path, dof, i), dof)
        total = total + (type(step) == 'number' and step or error('distCallback has to return a number.', 2))
        lengths[i] = total
    end
    return lengths, total
end

local function closed(path, lengths, level)
    local dof = dofOf(path, lengths, level + 1)
    local first, last = config(path, dof, 1), config(path, dof, #lengths)
    local closedPath = table.move(first, 1, dof, #path + 1, table.move(path, 1, #path, 1, {}))
    local closedLengths = table.move(lengths, 1, #lengths, 1, {})
    closedLengths[#lengths + 1] = lengths[#lengths] + pointDistance(last, first, dof)
    return closedPath, closedLengths
end

local CLOSE_ARGS = {{type = 'table', item_type = 'float', size = '1..*'}, {type = 'table', item_type = 'float', size = '1..*'}}

--- Appends the first point of a path to its end.
-- @api float[] path, float[] lengths = sim.closePath(float[] path, float[] lengths)
-- @param path flat table of points
-- @param lengths from sim.getPathLengths
-- @return path with one more point
-- @return lengths with one more value
function M.closePath(...)
    local path, lengths = check(CLOSE_ARGS, ...)
    return closed(path, lengths, 2)
end

-- Whether every quaternion of the types has its four numbers.
local function fits(types, dof)
    local i = 1
    while i <= dof do
        local size = types[i] == QUATERNION and 4 or 1
        if i + size - 1 > dof then return false end
        i = i + size
    end
    return true
end

local DISTANCE_ARGS = {
    {type = 'table', item_type = 'float', size = '1..*'}, {type = 'table', item_type = 'float', size = '1..*'},
    {type = 'table', item_type = 'float', nullable = true}, {type = 'table', item_type = 'int', nullable = true},
}

--- Distance between two configurations.
-- @api float distance = sim.getConfigDistance(float[] a, float[] b, float[] metric = nil, int[] types = nil)
-- @param a the one
-- @param b the other
-- @param metric factor of each coordinate, default 1
-- @param types 0 linear, 1 cyclic, 2 (four times) quaternion; default 0
-- @return distance root of the sum of squares
function M.getConfigDistance(...)
    local a, b, metric, types = check(DISTANCE_ARGS, ...)
    metric, types = metric or {}, types or {}
    if #a ~= #b or not fits(types, #a) then error('Bad table size.', 2) end
    local sum, i = 0, 1
    while i <= #a do
        local kind, difference = types[i] or LINEAR, nil
        if kind == QUATERNION then
            difference = quaternion.angle(table.move(a, i, i + 3, 1, {}), table.move(b, i, i + 3, 1, {}))
        elseif kind == CYCLIC then
            -- A defect of 4.10, kept: this is where b is, not how far away it is.
            difference = wrap(a[i] + wrap(b[i] - a[i]))
        else
            difference = b[i] - a[i]
        end
        sum = sum + (difference * (metric[i] or 1)) ^ 2
        i = i + (kind == QUATERNION and 4 or 1)
    end
    return math.sqrt(sum)
end

local function blend(a, b, t, types)
    local result, i, n = {}, 1, #a
    while i <= n do
        local kind = types and types[i] or LINEAR
        if kind == QUATERNION then
            table.move(quaternion.slerp(table.move(a, i, i + 3, 1, {}), table.move(b, i, i + 3, 1, {}), t), 1, 4, i, result)
            i = i + 4
        else
            result[i] = kind == CYCLIC and wrap(a[i] + wrap(b[i] - a[i]) * t) or a[i] + (b[i] - a[i]) * t
            i = i + 1
        end
    end
    return result
end

-- A path ready to be asked for points. Segment k goes from point k to point k + 1.
local function curve(path, lengths, method, types, level)
    if method and method.closed then path, lengths = closed(path, lengths, level + 1) end
    local dof = dofOf(path, lengths, level + 1)
    if types and not fits(types, dof) then error('Bad table size.', level) end
    local self = {path = path, lengths = lengths, dof = dof, types = types, segments = #lengths - 1}
    if method and method.type == 'quadraticBezier' then
        self.width = math.max(0.05, tonumber(method.strength) or 1)
        self.loop = not method.forceOpen and pointDistance(config(path, dof, 1), config(path, dof, #lengths), dof) < 1e-6
    end
    return self
end

local function segmentAt(lengths, t)
    local low, high = 1, #lengths - 1
    while low < high do
        local middle = (low + high + 1) // 2
        if lengths[middle] <= t then low = middle else high = middle - 1 end
    end
    return low
end

local function onSegment(self, segment, t)
    return blend(config(self.path, self.dof, segment), config(self.path, self.dof, segment + 1), t, self.types)
end

local function neighbour(self, segment, offset)
    local other = segment + offset
    if other >= 1 and other <= self.segments then return other end
    return self.loop and (other < 1 and self.segments or 1) or nil
end

-- Rounds the corners: the last half width of a segment and the first of the next are one quadratic curve.
local function bezierAt(self, segment, u)
    local w = self.width
    local incoming = u > 1 - w / 2 and neighbour(self, segment, 1)
    if incoming then
        local v = u - (1 - w / 2)
        return blend(onSegment(self, segment, 1 - w / 2 + v / 2), onSegment(self, incoming, v / 2), v / w, self.types)
    end
    local outgoing = u < w / 2 and neighbour(self, segment, -1)
    if outgoing then
        return blend(
            onSegment(self, outgoing, 1 - w / 4 + u / 2), onSegment(self, segment, w / 4 + u / 2), 0.5 + u / w, self.types
        )
    end
    return onSegment(self, segment, u)
end

local function pointAt(self, t)
    local lengths = self.lengths
    local last = lengths[#lengths]
    t = t < 0 and 0 or t >= last and last - END_GAP or t
    local segment = segmentAt(lengths, t)
    local span = lengths[segment + 1] - lengths[segment]
    local u = span > 0 and (t - lengths[segment]) / span or 0.0
    if self.width then return bezierAt(self, segment, u) end
    return onSegment(self, segment, u)
end

local INTERPOLATION_ARGS = {
    {type = 'table', item_type = 'float', size = '2..*'}, {type = 'table', item_type = 'float', size = '2..*'}, {type = 'float'},
    {type = 'table', nullable = true}, {type = 'table', item_type = 'int', nullable = true, size = '1..*'},
}

local function isListOfNumbers(value)
    return type(value) == 'table' and #value >= 2 and type(value[1]) == 'number' and type(value[#value]) == 'number'
end

local function isTableOrNil(value) return value == nil or type(value) == 'table' end

local function plainlyValid(path, lengths, t, method, types)
    local numbers = isListOfNumbers(path) and isListOfNumbers(lengths) and type(t) == 'number'
    return numbers and isTableOrNil(method) and isTableOrNil(types)
end

--- Configuration at a distance along a path.
-- @api float[] config = sim.getPathInterpolatedConfig(float[] path, float[] lengths, float t, map method = nil, int[] types = nil)
-- @param path flat table of points
-- @param lengths from sim.getPathLengths, or times
-- @param t distance from the start
-- @param method type (linear or quadraticBezier), strength, forceOpen, closed
-- @param types 0 linear, 1 cyclic, 2 (four times) quaternion
-- @return config interpolated
function M.getPathInterpolatedConfig(...)
    -- Called at every step with long paths: the full check of every element is left to the doubtful cases.
    if not plainlyValid(...) then check(INTERPOLATION_ARGS, ...) end
    local path, lengths, t, method, types = ...
    if t ~= t then error('invalid data.', 2) end
    local point = pointAt(curve(path, lengths, method, types, 3), t)
    return point
end

local MAX_POINTS <const> = 1000000 -- beyond, a mistyped number would keep the script busy for minutes
local RESAMPLE_ARGS = {
    {type = 'table', item_type = 'float', size = '2..*'}, {type = 'table', item_type = 'float', size = '2..*'}, {type = 'int'},
    {type = 'table', nullable = true}, {type = 'table', item_type = 'int', nullable = true, size = '1..*'},
}

--- Points at equal distances along a path.
-- @api float[] path = sim.resamplePath(float[] path, float[] lengths, int count, map method = nil, int[] types = nil)
-- @param path flat table of points
-- @param lengths from sim.getPathLengths
-- @param count number of points wanted
-- @param method as in sim.getPathInterpolatedConfig
-- @param types as in sim.getPathInterpolatedConfig
-- @return path flat table of count points, both ends included
function M.resamplePath(...)
    local path, lengths, count, method, types = check(RESAMPLE_ARGS, ...)
    if count > MAX_POINTS then error('sim.resamplePath: at most ' .. MAX_POINTS .. ' points can be made', 2) end
    local self, result = curve(path, lengths, method, types, 3), {}
    local total = self.lengths[#self.lengths]
    for i = 1, count do
        local point = pointAt(self, count > 1 and total * (i - 1) / (count - 1) or 0)
        table.move(point, 1, self.dof, #result + 1, result)
    end
    return result
end

local function projection(a, b, p)
    local dot, square = 0, 0
    for i = 1, 3 do
        dot = dot + (p[i] - a[i]) * (b[i] - a[i])
        square = square + (b[i] - a[i]) ^ 2
    end
    local u = square > 0 and math.max(0, math.min(1, dot / square)) or 0
    local distance = 0
    for i = 1, 3 do distance = distance + (a[i] + (b[i] - a[i]) * u - p[i]) ^ 2 end
    return u, distance
end

local CLOSEST_ARGS = {
    {type = 'table', item_type = 'float', size = '3..*'}, {type = 'table', item_type = 'float', size = '1..*'},
    {type = 'table', item_type = 'float', size = 3},
}

--- Distance along a path to its point closest to a given one.
-- @api float t = sim.getClosestPosOnPath(float[] path, float[] lengths, float[3] position)
-- @param path flat table of points; their first three coordinates count
-- @param lengths from sim.getPathLengths
-- @param position the given point
-- @return t for sim.getPathInterpolatedConfig
function M.getClosestPosOnPath(...)
    local path, lengths, position = check(CLOSEST_ARGS, ...)
    local dof = dofOf(path, lengths, 2)
    if dof < 3 then error('Bad table size.', 2) end
    local best, closest = math.huge, 0.0
    for segment = 1, #lengths - 1 do
        local u, distance = projection(config(path, dof, segment), config(path, dof, segment + 1), position)
        if distance < best then
            best, closest = distance, lengths[segment] + u * (lengths[segment + 1] - lengths[segment])
        end
    end
    return closest + 0.0
end

--- Inverse of a quaternion.
-- @api float[4] quaternion = sim.getQuaternionInverse(float[4] quaternion)
-- @param quaternion x, y, z, w
-- @return quaternion the opposite rotation
function M.getQuaternionInverse(...)
    local q = check({{type = 'table', item_type = 'float', size = 4}}, ...)
    return quaternion.inverse(q)
end

return M
