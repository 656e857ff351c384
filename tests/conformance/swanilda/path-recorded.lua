-- as: sandbox
-- passes: 0
-- spec: paths 2; a path saved by CoppeliaSim 4.3 (closed, orientation computed, 240 points)
-- tol: 1e-7
-- topic: motion
sim = require 'sim'

local POSITIONS <const> = {
    {0.254900008, 0, -0.0149999997}, {0.235489994, 0.0975449979, 0}, {0.180240005, 0.180240005, 0.0130000003},
    {0.0975449979, 0.235489994, 0}, {-1.11420002e-08, 0.254900008, 0.0130000003}, {-0.247549996, 0.610490024, 0.100000001},
    {-0.180240005, 0.180240005, 0}, {-0.235489994, 0.0975449979, -0.0170000009}, {-0.604900002, 0.125, 0},
    {-0.235489994, -0.0975449979, 0.0280000009}, {-0.180240005, -0.180240005, 0}, {-0.0975449979, -0.235489994, -0.0219999999},
    {3.03959991e-09, -0.504899979, 0.109999999}, {0.0975449979, -0.235489994, -0.0299999993}, {0.180240005, -0.180240005, 0},
    {0.235489994, -0.0975449979, 0.0140000004},
}
local points = {}
for _, p in ipairs(POSITIONS) do
    for _, x in ipairs{p[1], p[2], p[3], 0, 0, 0, 1} do points[#points + 1] = x end
end
local object = sim.createPath(points, 2 | 16, 240, 1, 1, {0, 0, 1})
local path = sim.unpackDoubleTable(sim.getBufferProperty(object, 'customData.PATH'))
for _, i in ipairs{0, 1, 60, 120, 200, 239} do
    print(i, string.format(('%.9f '):rep(7), table.unpack(path, 7 * i + 1, 7 * i + 7)))
end
