-- Tests of a robot: run them with `swanilda test`.
local sim = require 'sim'
local t = require 'swanilda.test'

describe('a ball', function()
    local ball

    before_each(function()
        -- Or bring a scene of yours in: t.load('robot.ttt')
        ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, { 0.2, 0.2, 0.2 })
        sim.setObjectAlias(ball, 'ball')
        sim.setObjectInt32Param(ball, sim.shapeintparam_static, 0)
        sim.setObjectInt32Param(ball, sim.shapeintparam_respondable, 1)
        sim.setObjectPosition(ball, { 0, 0, 1 })
    end)

    local function height() return sim.getObjectPosition(ball)[3] end

    it('falls', function()
        t.run_for(0.3)
        assert.near(1 - 9.81 * 0.3 ^ 2 / 2, height(), 0.03)
    end)

    it('comes to rest on the floor', function()
        t.run_until(function() return height() < 0.11 end, 2)
        t.run_for(1)
        assert.near(0.1, height(), 0.005)
    end)

    it('stays where its controller says', function()
        local controller = t.script(sim.createScript(sim.scripttype_simulation, [[
            sim = require 'sim'
            goal = 0.5
            function sysCall_actuation() sim.setObjectPosition(sim.getObject('/ball'), { 0, 0, goal }) end
        ]]))
        t.step(2)
        controller:set('goal', 0.7)
        t.step(2)
        assert.near(0.7, height(), 0.05)
    end)
end)
