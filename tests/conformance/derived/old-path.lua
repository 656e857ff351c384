-- topic: old paths
-- as: sandbox
-- passes: 0
-- spec: vrep-era 3
sim = require 'sim'
local p = sim.createPath(0)
print(sim.getObjectType(p) == sim.sceneobject_path, sim.sceneobject_path, sim.getPathLength(p), sim.getPathPosition(p))
local function pt(x) return x, 0, 0, 0, 0, 0, 1, 0, 1, 0.5, 0.5 end
local data = {pt(0)}
for _, v in ipairs{pt(2)} do data[#data + 1] = v end
print(sim.insertPathCtrlPoints(p, 0, 0, 2, data), sim.getPathLength(p))
print(sim.setPathPosition(p, 0.5), sim.getPathPosition(p))
print(sim.setPathPosition(p, 9), sim.getPathPosition(p), sim.setPathPosition(p, -1), sim.getPathPosition(p))
sim.setObjectPosition(p, {10, 0, 0})
local function x(t) return string.format('%.3f', t[1]) end
print(x(sim.getPositionOnPath(p, 0.25)), x(sim.getPositionOnPath(p, -1)), x(sim.getPositionOnPath(p, -2)))
print(sim.getClosestPositionOnPath(p, {0.5, 1, 0}))
print(sim.getDataOnPath(p, 0.5))
local function try(...)
    local ok, e = pcall(...)
    print(ok, (tostring(e):gsub('^%-?%d+: ', '')))
end
local d = sim.createDummy(0.01)
try(sim.getPathPosition, d)
try(sim.getPathLength, 999998)
try(sim.getPositionOnPath, p, -3)
print(sim.cutPathCtrlPoints(p, -1, 0), sim.getPathLength(p))
try(sim.getPositionOnPath, p, 0.5)
try(sim.insertPathCtrlPoints, d, 0, 0, 1, {pt(0)})
