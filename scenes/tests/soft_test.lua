-- simSoft: what holds ropes, what they bear, and what is refused.
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
        assert.error_matches(function() simSoft.pin(rope, 11) end, 'the rope has no point 11')
        assert.error_matches(function() simSoft.getPoints(box) end, 'the shape is no rope')
    end)
end)
