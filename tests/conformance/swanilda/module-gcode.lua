-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: libraries 1; gcode
local gcode = require 'gcode'
local function show(p) return ('%.4f %.4f %.4f'):format(p[1] + 0.0, p[2] + 0.0, p[3] + 0.0) end
function gcode:onBeginLine(line) if line:find('%(') then print('line', line) end end
gcode:runProgram([[
G21 G90 (millimetres, absolute)
g0 x10 ; to the start
N20 G2 X0 Y-10 I-10 J0 F600
G3 X10 Y0 R10
G3 X10 Y0 I-10
G91
G1 Z5
X-1
G20
X1
G28
A90
M3
]], true)
for _, m in ipairs(gcode.motions) do
    print(m.code, #m.path, show(m.path[1]), show(m.path[#m.path]), m.speed and ('%.4f'):format(m.speed), ('%.4f'):format(m.position.A))
end
-- a quarter of a turn clockwise from (10, 0) around the origin, halfway at -45 degrees; back the same way; a whole turn, halfway at 180
local function middle(m) return show(m.path[(#m.path + 1) // 2]) end
print(middle(gcode.motions[2]), middle(gcode.motions[3]), middle(gcode.motions[4]))
print(#gcode:createCircularPath({1, 0, 0}, {0, 1, 0}, 1, -1), #gcode:createCircularPath({1, 0, 0}, {0, 1, 0}, 1, 1))
print(pcall(gcode.createCircularPath, gcode, {1, 0, 0}, {9, 1, 0}, 1, 1))
