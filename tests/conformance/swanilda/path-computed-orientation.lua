-- as: sandbox
-- passes: 0
-- spec: paths 2; the orientation computed from the direction: f = direction, r = f x up, axes by mode
-- tol: 1e-6
-- topic: motion
sim = require 'sim'

local function axes(pose)
    local m, text = sim.poseToMatrix(pose), {}
    for column = 1, 3 do
        text[column] = string.format('(%.4f %.4f %.4f)', m[column] + 0.0, m[4 + column] + 0.0, m[8 + column] + 0.0):gsub('%-(0%.0000)', '%1')
    end
    return table.concat(text, ' ')
end

local function show(direction, up, mode)
    local points = {0, 0, 0, 0, 0, 0, 1, direction[1], direction[2], direction[3], 0, 0, 0, 1}
    local path = sim.createPath(points, 16, 3, 0, mode, up)
    local poses = sim.unpackDoubleTable(sim.getBufferProperty(path, 'customData.PATH'))
    print(mode, axes(table.move(poses, 8, 14, 1, {})))
    sim.removeModel(path)
end

local UP <const>, SIDE <const> = {0, 0, 1}, {0, 1, 0}
for _, pair in ipairs{
    {{1, 0, 0}, UP}, {{-1, 0, 0}, UP}, {{0, 1, 0}, UP}, {{0, -1, 0}, UP}, {{0, 0, 1}, SIDE}, {{0, 0, -1}, SIDE}, {{-2, -2, -2}, {2, 1, -1}}, {{-2, -2, 2}, {1, 2, 2}},
    {{1, 0, 0}, {0, -1, 0}}, {{-1, 0, 0}, {0, 1, 0}}, {{-1, 0, 0}, {0, -1, 0}}, -- half turns about x, y and z in mode 0
} do
    print('direction', table.unpack(pair[1]))
    for mode = 0, 5 do show(pair[1], pair[2], mode) end
end
