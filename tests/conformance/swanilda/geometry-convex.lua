-- topic: shapes
-- as: simulation
-- passes: 2
-- sim.getQHull, sim.convexDecompose, sim.generateShapeFromPath, groups of groups; refusals.
sim = require 'sim'

local function refused(f, ...) print((select(2, pcall(f, ...)):gsub('^.-: ', ''))) end

local function cube(x)
    local h = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectPosition(h, {x, 0, 0})
    return h
end

function sysCall_init()
    local v, i = sim.getQHull{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 0.1, 1, 0, 0}
    print(#v, #i)
    refused(sim.getQHull, {})
    refused(sim.getQHull, {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3})
    refused(sim.getQHull, {0 / 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1})

    local angle = sim.groupShapes({cube(0), cube(0.1), sim.createPrimitiveShape(3, {0.1, 0.5, 0.1})}, true)
    sim.setShapeMass(angle, 3)
    local pieces = sim.convexDecompose(angle, 0)
    print(pieces ~= angle, sim.getShapeGeomInfo(pieces), sim.getShapeMass(pieces), sim.isHandle(angle))
    print(sim.convexDecompose(angle, 1) == angle, (sim.getShapeGeomInfo(angle)))
    refused(sim.convexDecompose, sim.createPrimitiveShape(sim.primitiveshape_plane, {1, 1, 0}), 0)
    refused(sim.convexDecompose, 12345, 0)

    local tube = sim.generateShapeFromPath({0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 0, 1}, {0.1, -0.1, 0.1, 0.1, -0.1, 0.1, 0.1, -0.1})
    local vertices, indices = sim.getShapeMesh(tube)
    print(#vertices // 3, #indices // 3)
    refused(sim.generateShapeFromPath, {0, 0, 0, 0, 0, 0, 1}, {0, 0, 1, 1})
    refused(sim.generateShapeFromPath, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1}, {0, 0, 0, 0})

    local pair = sim.groupShapes{cube(0), cube(1)}
    sim.setShapeMass(pair, 6)
    local three = sim.groupShapes{pair, cube(2)}
    print(sim.getShapeMass(three))
    local members = sim.ungroupShape(three)
    print(#members, sim.getObjectPosition(members[1])[1], sim.getShapeMass(members[1]), #sim.ungroupShape(members[1]))
end
