-- The cart that balances a pole.
local sim = require 'sim'
local t = require 'swanilda.test'

describe('the inverted pendulum', function()
    local controller

    before_each(function()
        t.load('../inverted_pendulum.lua')
        controller = t.script('/Rail/Slider/Controller')
    end)

    local function lean() return math.deg(math.abs((controller:call('state')))) end

    it('balances the pole, pushed or not', function()
        t.run_for(3)
        assert.is_true(lean() < 1)
        t.run_for(6.9)
        assert.is_true(lean() < 2)
    end)

    it('stands a motor with friction', function()
        t.step()
        t.faults.friction('/Rail/Slider', 5)
        t.run_for(5)
        assert.is_true(lean() < 5)
    end)

    it('falls without a controller', function()
        t.step()
        controller:stub('sim.setJointTargetVelocity')
        t.run_until(function() return lean() > 45 end, 3)
    end)
end)
