-- as: customization
-- passes: 2
-- spec: vrep-era 2.7, vrep-era 2.8, vrep-era 3.3
-- topic: old functions
sim = require 'sim'

local function try(...) print((tostring(select(2, pcall(...))):gsub('^%-?%d+: ', ''))) end

local function number(value) return string.format('%.3f', value + 1e-9) end

function sysCall_init()
    local goods = sim.createCollection('goods', 1)
    print(sim.getCollectionHandle('goods') == goods, sim.getCollectionName(goods), sim.setCollectionName(goods, 'wares'))
    try(sim.createCollection, 'wares', 0)
    try(sim.setCollectionName, goods, 'my wares')
    print(sim.getCollectionHandle('goods@silentError'), sim.removeCollection(goods))
    try(sim.getCollectionHandle, 'wares')

    print(sim.addBanner('a', 0.1, 0), sim.addBanner('b', 0.1, 0), sim.removeBanner(1), sim.addBanner('c', 0.1, 0), sim.removeBanner(sim.handle_all))
    try(sim.removeBanner, 1)
    print(sim.cameraFitToView(0), select('#', sim.test('anything')))

    path = sim.createPath(0x24)
    local points = {}
    for _, corner in ipairs{{0, 0}, {1, 0}, {1, 1}, {0, 1}} do
        for _, value in ipairs{corner[1], corner[2], 0, 0, 0, 0, 1, 0, 1, 0.5, 0.5, 3, corner[1], 0, 0, 0} do points[#points + 1] = value end
    end
    print(sim.insertPathCtrlPoints(path, 3, 0, 4, points), number(sim.getPathLength(path)))
    print(sim.setPathPosition(path, 4.25), number(sim.getPathPosition(path)))
    local p, data = sim.getPositionOnPath(path, 0.5), {sim.getDataOnPath(path, 0.125)}
    print(number(p[1]), number(p[2]), data[1], number(data[2][1]))
    local angles = sim.getOrientationOnPath(path, 0.3)
    print(number(angles[1]), number(angles[2]), number(angles[3]))
    try(simHandlePath, path, 0.1)
    try(sim.insertPathCtrlPoints, path, 0, 0, 2, {1, 2, 3})
    sim.setExplicitHandling(path, 1)
    sim.setPathTargetNominalVelocity(path, 1)
    print(sim.getExplicitHandling(path), simHandlePath(path, 0.5), number(sim.getPathPosition(path)))
    print(simHandlePath(sim_handle_all, 0.5), number(sim.getPathPosition(path)), simResetPath(path))
    local copy = sim.copyPasteObjects({path}, 0)[1]
    print(sim.getObjectType(copy) == sim.sceneobject_path, number(sim.getPathPosition(copy)), sim.getObjectAlias(copy))
    try(simSearchPath, 1, 2)
end

function sysCall_sensing() print('explicit', number(sim.getPathPosition(path))) end
