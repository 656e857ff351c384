-- simSoft: what holds ropes, cloths and volumes, what they bear, and what is refused.
local t = require 'swanilda.test'

-- The coordinates of a point.
local function point(rope, index)
    local points = simSoft.getPoints(rope)
    return {points[3 * index + 1], points[3 * index + 2], points[3 * index + 3]}
end

local function near(expected, value, tolerance) assert.is_true(math.abs(value - expected) < tolerance, value .. ' is not ' .. expected) end

describe('a rope', function()
    local rope, box

    before_each(function()
        sim = require 'sim'
        simSoft = require 'simSoft'
        rope = simSoft.createRope{from = {0, 0, 1}, to = {0, 0, 0.5}, count = 10, mass = 0.2, drag = 5, damping = 0.01}
        box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
        sim.setObjectPosition(box, {0, 0, 0.45})
        sim.setShapeMass(box, 2)
        sim.setObjectInt32Param(box, sim.shapeintparam_static, 0)
    end)

    it('is a shape with a mass and a form', function()
        assert.equal(sim.object_shape_type, sim.getObjectType(rope))
        near(0.2, sim.getShapeMass(rope), 1e-9)
        assert.equal(33, #simSoft.getPoints(rope))
        local vertices = sim.getShapeMesh(rope)
        assert.equal(11 * 8 * 3, #vertices)
    end)

    it('bears what hangs on it, and lets go', function()
        simSoft.pin(rope, 0)
        simSoft.pin(rope, 10, box)
        t.run_for(5)
        near(2 * 9.81, simSoft.getTensions(rope)[10], 0.1)
        near(2.2 * 9.81, simSoft.getPinForce(rope, 0)[3], 0.1)
        near(0.45, sim.getObjectPosition(box)[3], 2e-3)
        simSoft.unpin(rope, 10)
        t.run_for(0.5)
        assert.is_true(sim.getObjectPosition(box)[3] < 0)
        assert.same({0, 0, 0}, simSoft.getPinForce(rope, 10))
        near(1, point(rope, 0)[3], 1e-6)
        simSoft.unpin(rope)
        t.run_for(0.5)
        assert.is_true(point(rope, 0)[3] < 0.6)
    end)

    it('is held where a script says, and goes along with a dummy', function()
        local dummy = sim.createDummy(0.01)
        sim.setObjectPosition(dummy, {0.2, 0, 1})
        simSoft.pin(rope, 0, dummy, {position = {0.2, 0, 1.1}})
        t.run_for(1)
        near(1.1, point(rope, 0)[3], 1e-6)
        sim.setObjectPosition(dummy, {0.2, 0.1, 1})
        t.run_for(0.05)
        near(0.1, point(rope, 0)[2], 1e-6)
    end)

    it('breaks where it is told to, and where it is pulled too hard', function()
        simSoft.pin(rope, 0)
        t.run_for(0.5)
        simSoft.breakEdge(rope, 4)
        t.run_for(0.5)
        assert.same({4}, simSoft.getBrokenEdges(rope))
        assert.is_true(point(rope, 5)[3] < 0.5 and point(rope, 4)[3] > 0.7)
        local weak = simSoft.createRope{from = {1, 0, 1}, to = {1, 0, 0.5}, count = 10, mass = 0.2, strength = 1}
        simSoft.pin(weak, 0)
        t.run_for(0.5)
        assert.equal(0, simSoft.getBrokenEdges(weak)[1])
    end)

    it('is put elsewhere', function()
        simSoft.pin(rope, 0)
        t.run_for(0.1)
        local points = simSoft.getPoints(rope)
        for i = 1, #points, 3 do points[i] = points[i] + 1 end
        simSoft.unpin(rope)
        simSoft.setPoints(rope, points)
        t.run_for(0.05)
        near(1, point(rope, 5)[1], 1e-3)
    end)

    it('is where it began after the simulation, and so is its mesh', function()
        local before = simSoft.getPoints(rope)
        local mesh = sim.getShapeMesh(rope)
        t.run_for(0.5)
        assert.not_same(before, simSoft.getPoints(rope))
        t.stop()
        assert.same(before, simSoft.getPoints(rope))
        assert.same(mesh, (sim.getShapeMesh(rope)))
    end)

    it('is copied with what it is', function()
        simSoft.pin(rope, 0)
        local copy = sim.copyPasteObjects({rope}, 0)[1]
        t.run_for(1)
        near(1, point(copy, 0)[3], 1e-6)
        assert.equal(33, #simSoft.getPoints(copy))
    end)

    it('refuses what it does not know', function()
        assert.error_matches(function() simSoft.createRope{} end, "a rope needs 'points', or 'from' and 'to'")
        assert.error_matches(function() simSoft.createRope{from = {0, 0, 0}, to = {1, 0, 0}, colour = 1} end, "there is no option 'colour'")
        assert.error_matches(function() simSoft.createRope{from = {0, 0, 0}, to = {1, 0, 0}, radius = -1} end, "invalid value of option 'radius'")
        assert.error_matches(function() simSoft.pin(rope, 11) end, 'the shape has no point 11')
        assert.error_matches(function() simSoft.getPoints(box) end, 'the shape is not soft')
    end)
end)

describe('a cloth', function()
    local cloth

    before_each(function()
        sim = require 'sim'
        simSoft = require 'simSoft'
        cloth = simSoft.createCloth{size = {0.4, 0.4}, count = {4, 4}, pose = {0, 0, 1, 0, 0, 0, 1}, mass = 0.1, drag = 5}
    end)

    it('is a shape with a mass, points and triangles', function()
        near(0.1, sim.getShapeMass(cloth), 1e-9)
        assert.equal(25 * 3, #simSoft.getPoints(cloth))
        assert.equal(32 * 3, #simSoft.getTriangles(cloth))
        local corner = point(cloth, 0)
        near(-0.2, corner[1], 1e-9)
        near(1, corner[3], 1e-9)
        assert.equal(sim.handle_world, sim.getObjectParent(cloth))
    end)

    it('hangs from its pins, which bear it', function()
        for _, node in ipairs{20, 21, 22, 23, 24} do simSoft.pin(cloth, node) end
        t.run_for(4)
        near(0.2, point(cloth, 0)[2], 0.02)
        near(0.6, point(cloth, 0)[3], 0.02)
        local force = 0
        for node = 20, 24 do force = force + simSoft.getPinForce(cloth, node)[3] end
        near(0.1 * 9.81, force, 0.01)
        t.stop()
        near(1, point(cloth, 0)[3], 1e-9)
    end)

    it('tears where it is pulled too hard', function()
        sim.removeObjects{cloth}
        cloth = simSoft.createCloth{size = {0.4, 0.4}, count = {4, 4}, pose = {0, 0, 1, 0, 0, 0, 1}, mass = 1, strength = 5}
        simSoft.pin(cloth, 0)
        t.run_for(1)
        assert.is_true(#simSoft.getTriangles(cloth) < 32 * 3)
        assert.is_true(point(cloth, 24)[3] < 0.01)
    end)

    it('is made of the mesh of a shape, and holds gas', function()
        local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.2, 0.2, 0.2})
        sim.setObjectPosition(ball, {1, 0, 1})
        local balloon = simSoft.createCloth{shape = ball, thickness = 0.0005, young = 1e6, pressure = 8000, mass = 0.02}
        sim.removeObjects{ball}
        local before = simSoft.getVolume(balloon)
        near(4 / 3 * math.pi * 0.001, before, 2e-4)
        simSoft.pin(balloon, 0)
        t.run_for(1)
        local volume, pressure = simSoft.getVolume(balloon), simSoft.getPressure(balloon)
        assert.is_true(volume > before * 1.005, volume)
        near((8000 + 101325) * before / volume - 101325, pressure, 1)
    end)

    it('is copied, saved and loaded with what it is', function()
        simSoft.pin(cloth, 0)
        simSoft.pin(cloth, 4)
        sim.setModelProperty(cloth, 0)
        local file = os.tmpname()
        sim.saveModel(cloth, file)
        local loaded = sim.loadModel(file)
        os.remove(file)
        t.run_for(1)
        near(1, point(loaded, 0)[3], 1e-6)
        for i, x in ipairs(simSoft.getPoints(cloth)) do near(x, simSoft.getPoints(loaded)[i], 1e-6) end
    end)

    it('refuses what it does not know', function()
        assert.error_matches(function() simSoft.createCloth{} end, "a cloth needs 'size', or 'vertices' and 'triangles', or 'shape'")
        assert.error_matches(function() simSoft.createCloth{size = {1, 1}, colour = 1} end, "there is no option 'colour'")
        assert.error_matches(function() simSoft.createCloth{size = {1, 1}, count = {0, 1}} end, "invalid value of option 'count'")
        assert.error_matches(function() simSoft.createCloth{vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0}, triangles = {0, 1, 3}} end, 'no cloth or volume: a point is missing')
        assert.error_matches(function() simSoft.createCloth{vertices = {0, 0, 0, 1, 0, 0, 2, 0, 0}, triangles = {0, 1, 2}} end, 'a triangle has no area')
        assert.error_matches(function() simSoft.createVolume{size = {1, 1, 1}, poisson = 0.5} end, 'a number is out of range')
        assert.error_matches(function() simSoft.pin(cloth, 25) end, 'has no point 25')
        assert.error_matches(function() simSoft.pin(cloth, 0, -1, {clamp = true}) end, 'only ropes and cables are clamped')
        assert.error_matches(function() simSoft.breakEdge(cloth, 32) end, 'has no edge or triangle 32')
    end)
end)

describe('a volume', function()
    before_each(function()
        sim = require 'sim'
        simSoft = require 'simSoft'
        local floor = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {2, 2, 0.1})
        sim.setObjectPosition(floor, {0, 0, -0.05})
        sim.setObjectInt32Param(floor, sim.shapeintparam_respondable, 1)
    end)

    it('fills a closed mesh and falls on the floor', function()
        local ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, {0.1, 0.1, 0.1})
        sim.setObjectPosition(ball, {0, 0, 0.2})
        local soft = simSoft.createVolume{shape = ball, cell = 0.02, young = 5e4, density = 300}
        sim.removeObjects{ball}
        near(4 / 3 * math.pi * 0.05 ^ 3, simSoft.getVolume(soft), 5e-5)
        t.run_for(2)
        local lowest, highest = math.huge, -math.huge
        local points = simSoft.getPoints(soft)
        for i = 3, #points, 3 do lowest, highest = math.min(lowest, points[i]), math.max(highest, points[i]) end
        near(0.001, lowest, 5e-4)
        assert.is_true(highest > 0.08 and highest < 0.102, highest)
    end)

    it('refuses a mesh that is open', function()
        local plane = sim.createPrimitiveShape(sim.primitiveshape_plane, {1, 1, 0})
        assert.error_matches(function() simSoft.createVolume{shape = plane} end, 'the mesh is not closed')
    end)
end)
