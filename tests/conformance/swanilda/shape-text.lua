-- topic: shapes
-- as: sandbox
-- passes: 0
-- spec: libraries 1; shapes of letters
sim = require 'sim'
local textUtils = require 'textUtils'
local function show(model)
    local shape = sim.getObjectsInTree(model, sim.sceneobject_shape)[1]
    local low, high = {math.huge, math.huge, math.huge}, {-math.huge, -math.huge, -math.huge}
    local vertices, indices = sim.getShapeMesh(shape)
    local pose = sim.getObjectPose(shape)
    for i = 1, #vertices, 3 do
        local p = sim.multiplyVector(sim.poseToMatrix(pose), {vertices[i], vertices[i + 1], vertices[i + 2]})
        for k = 1, 3 do low[k], high[k] = math.min(low[k], p[k]), math.max(high[k], p[k]) end
    end
    local function text(p) return ('%.3f %.3f %.3f'):format(p[1] + 0.0, p[2] + 0.0, p[3] + 0.0):gsub('%-0%.000', '0.000') end
    print(sim.getObjectAlias(model), #indices // 3, (text(low)), (text(high)), select(2, sim.getShapeColor(shape, nil, 0)))
end
-- a stroke is a bar of 12 triangles, a tenth of the height wide: half of that goes beyond the lines. A letter is 4 / 6 of its height wide, the next
-- one begins after 2 / 6 more, lines are 9 / 6 apart
show(textUtils.generateTextShape('L', {1, 0, 0}, 0.6))
show(sim.generateTextShape('L', {1, 0, 0}, 0.6))
show(sim.generateTextShape('LL', nil, 0.6, true))
show(sim.generateTextShape('I\nI', {0, 1, 0}, 0.6))
show(sim.generateTextShape('i', nil, 0.6))
show(sim.generateTextShape('\u{e9}'))
local parent = sim.createDummy(0.1)
sim.setObjectAlias(parent, 'parent')
show(textUtils.generateTextShape('-', nil, 0.6, false, nil, parent))
print(sim.getObjectType(textUtils.generateTextShape('-', nil, 0.6, false, nil, nil, true)) == sim.sceneobject_shape)
print((select(2, pcall(textUtils.generateTextShape, ' \n')):gsub('^.-:%d+: ', '')))
for code = 33, 126 do
    textUtils.generateTextShape(string.char(code), nil, 0.6, false, nil, nil, true)
end
