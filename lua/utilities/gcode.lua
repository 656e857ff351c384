--[[
Programs for machine tools in G-code: an interpreter that turns lines of text into paths.

    local gcode = require 'gcode'
    gcode:runProgram('G21 G90\nG0 X10 Y0\nG2 X0 Y10 I-10 J0 F600')
    for _, motion in ipairs(gcode.motions) do print(motion.code, #motion.path) end

A line is words of a letter and a number, with comments in parentheses or after a semicolon. A word calls the function of its code (gcode.G2) or
of its letter (gcode.X); then executeMotion makes the path from the last position, in metres, if an axis was named. Known are G0 and G1
(straight), G2 and G3 (arcs in the xy plane, by I and J or by R), G4 (a pause of P milliseconds), G20 and G21 (inches, millimetres),
G28 (to the origin), G90 and G91 (absolute, relative). Other codes are logged and skipped.

A script may replace any function, above all executeMotion, onBeginProgram, onEndProgram, onBeginLine and onEndLine. Of the original only names
and parameters are known: fields, points {x, y, z} and what executeMotion does are ours.
]]

local gcode = {}

local WARNING <const> = 430 -- sim.verbosity_scriptwarnings
local ARC_STEP <const> = math.rad(5)
local CLOCKWISE <const>, COUNTERCLOCKWISE <const> = -1, 1
local MILLIMETRE <const>, INCH <const> = 0.001, 0.0254

--- Begins again: at the origin, in millimetres, absolute. `motions` is emptied.
-- @api gcode:reset()
function gcode:reset()
    self.position = {X = 0, Y = 0, Z = 0, A = 0, B = 0, C = 0, U = 0, V = 0, W = 0}
    self.target, self.offset, self.radius, self.dwell = {}, {}, nil, 0
    self.unit, self.isRelative, self.motion, self.speed = MILLIMETRE, false, 'G0', nil
    self.motions = {}
end

---------------------------------------------------------------- paths

--- The points of a straight path.
-- @api table points = gcode:createLinearPath(float[3] from, float[3] to)
function gcode:createLinearPath(from, to) return {from, to} end

--- The points of an arc in the xy plane. z changes evenly.
-- @param direction -1 clockwise, 1 counterclockwise
-- @param centerOrRadius {x, y}, or a radius; negative: the long way round
-- @api table points = gcode:createCircularPath(float[3] from, float[3] to, int direction, any centerOrRadius)
function gcode:createCircularPath(from, to, direction, centerOrRadius)
    if type(centerOrRadius) == 'table' then return self:createCircularPathWithCenter(from, to, direction, centerOrRadius) end
    return self:createCircularPathWithRadius(from, to, direction, centerOrRadius)
end

--- The points of an arc around a centre; a whole turn where it ends at its start.
-- @api table points = gcode:createCircularPathWithCenter(float[3] from, float[3] to, int direction, float[2] center)
function gcode:createCircularPathWithCenter(from, to, direction, center)
    local x, y = from[1] - center[1], from[2] - center[2]
    local first = math.atan(y, x)
    local turn = (math.atan(to[2] - center[2], to[1] - center[1]) - first) * direction % (2 * math.pi)
    if turn < 1e-9 then turn = 2 * math.pi end
    local count, radius, points = math.max(1, math.ceil(turn / ARC_STEP - 1e-9)), (x * x + y * y) ^ 0.5, {from}
    for i = 1, count - 1 do
        local angle = first + direction * turn * i / count
        points[i + 1] = {center[1] + radius * math.cos(angle), center[2] + radius * math.sin(angle), from[3] + (to[3] - from[3]) * i / count}
    end
    points[count + 1] = to
    return points
end

--- The points of an arc with a radius.
-- @api table points = gcode:createCircularPathWithRadius(float[3] from, float[3] to, int direction, float radius)
function gcode:createCircularPathWithRadius(from, to, direction, radius)
    local dx, dy = to[1] - from[1], to[2] - from[2]
    local chord = (dx * dx + dy * dy) ^ 0.5
    local rest = radius * radius - chord * chord / 4
    if chord == 0 or rest < -1e-9 then error('gcode: no arc with this radius', 2) end
    local side = math.max(0, rest) ^ 0.5 * direction * (radius < 0 and -1 or 1)
    local center = {(from[1] + to[1]) / 2 - dy / chord * side, (from[2] + to[2]) / 2 + dx / chord * side}
    return self:createCircularPathWithCenter(from, to, direction, center)
end

---------------------------------------------------------------- programs

function gcode:onBeginProgram(_) end
function gcode:onEndProgram(_) end
function gcode:onBeginLine(_) end
function gcode:onEndLine(_) end

local function draw(motions)
    local sim = _quietRequire 'sim'
    local lines = sim.addDrawingObject(sim.drawing_lines, 2, 0, -1, 100000, {1, 0, 1})
    for _, motion in ipairs(motions) do
        for i = 2, #motion.path do
            local a, b = motion.path[i - 1], motion.path[i]
            sim.addDrawingObjectItem(lines, {a[1], a[2], a[3], b[1], b[2], b[3]})
        end
    end
end

--- Runs the lines of a program; with visualizePath its paths are drawn afterwards.
-- @api gcode:runProgram(string program, bool visualizePath = false)
function gcode:runProgram(program, visualizePath)
    self:reset()
    self:onBeginProgram(program)
    for line in (program .. '\n'):gmatch('(.-)\r?\n') do self:runLine(line) end
    self:onEndProgram(program)
    if visualizePath then draw(self.motions) end
end

local function runWord(self, letter, number)
    local value = tonumber(number)
    local code = letter .. (math.tointeger(value) or value)
    local isCode = letter == 'G' or letter == 'M'
    local f = isCode and self[code] or not isCode and self[letter]
    if type(f) ~= 'function' then
        addLog(WARNING, ('gcode: %s is not supported'):format(code))
    elseif isCode then
        f(self)
    else
        f(self, value)
    end
    return code
end

--- Runs a line.
-- @api gcode:runLine(string line)
function gcode:runLine(line)
    self:onBeginLine(line)
    local pause = false
    local text = line:gsub('%b()', ''):gsub(';.*', ''):upper()
    for letter, number in text:gmatch('(%u)%s*([-+]?[%d.]+)') do pause = runWord(self, letter, number) == 'G4' or pause end
    if next(self.target) then self:executeMotion() end
    if pause and self.dwell > 0 then _quietRequire('sim').wait(self.dwell / 1000) end
    self.target, self.offset, self.radius = {}, {}, nil
    self:onEndLine(line)
end

local function point(position) return {position.X, position.Y, position.Z} end

--- Makes the path to the position that a line names, adds {code, path, speed, position} to `motions`, and is there.
-- @api gcode:executeMotion()
function gcode:executeMotion()
    local from, code = point(self.position), self.motion
    for axis, value in pairs(self.target) do
        self.position[axis] = self.isRelative and self.position[axis] + value or value
    end
    local to, path = point(self.position), nil
    if code == 'G2' or code == 'G3' then
        local around = self.radius or {from[1] + (self.offset.I or 0), from[2] + (self.offset.J or 0)}
        path = self:createCircularPath(from, to, code == 'G2' and CLOCKWISE or COUNTERCLOCKWISE, around)
    else
        path = self:createLinearPath(from, to)
    end
    local position = {}
    for axis, value in pairs(self.position) do position[axis] = value end
    self.motions[#self.motions + 1] = {code = code, path = path, speed = self.speed, position = position}
end

---------------------------------------------------------------- codes and letters

for _, code in ipairs{'G0', 'G1', 'G2', 'G3'} do
    gcode[code] = function(self) self.motion = code end
end

function gcode:G4() end
function gcode:G20() self.unit = INCH end
function gcode:G21() self.unit = MILLIMETRE end
function gcode:G90() self.isRelative = false end
function gcode:G91() self.isRelative = true end

function gcode:G28()
    local isRelative, motion = self.isRelative, self.motion
    self.target, self.isRelative, self.motion = {X = 0, Y = 0, Z = 0}, false, 'G0'
    self:executeMotion()
    self.target, self.isRelative, self.motion = {}, isRelative, motion
end

for _, axis in ipairs{'X', 'Y', 'Z', 'U', 'V', 'W'} do
    gcode[axis] = function(self, value) self.target[axis] = value * self.unit end
end

-- Angles, in degrees.
for _, axis in ipairs{'A', 'B', 'C'} do
    gcode[axis] = function(self, value) self.target[axis] = math.rad(value) end
end

for _, axis in ipairs{'I', 'J', 'K'} do
    gcode[axis] = function(self, value) self.offset[axis] = value * self.unit end
end

-- The speed is in units a minute; in `speed` in metres a second.
function gcode:F(value) self.speed = value * self.unit / 60 end
function gcode:P(value) self.dwell = value end
function gcode:R(value) self.radius = value * self.unit end
function gcode:N(_) end

gcode:reset()

return gcode
