-- The robot that visits waypoints: where it drives, and what happens when something breaks.
local sim = require 'sim'
local t = require 'swanilda.test'

local function hasReached(number)
    for _, line in ipairs(t.prints()) do
        if line:find('stop ' .. number .. ' reached') then return true end
    end
    return false
end

describe('the two-wheeled robot', function()
    local route

    before_each(function()
        t.load('../two_wheel_robot.lua')
        route = t.script('/Robot/script')
    end)

    it('drives along its route', function()
        -- Wheels that slip make small differences larger: what counts is the way, to a centimetre.
        t.golden('route', { '/Robot' }, { absolute = 0.02, every = 0.5 })
        t.run_until(function() return hasReached(4) end, 30)
    end)

    it('comes home', function()
        t.run_until(function() return hasReached(4) end, 30)
        local p = sim.getObjectPosition(t.object('/Robot'))
        assert.near(0, p[1], 0.06)
        assert.near(0, p[2], 0.06)
    end)

    it('finds its way with noisy bearings', function()
        t.step()
        t.faults.noise(route, 'sim.getObjectOrientation', 0.05)
        t.run_until(function() return hasReached(4) end, 40)
    end)

    it('drives on blindly when its program dies', function()
        t.run_for(1)
        local before = sim.getObjectPosition(t.object('/Robot'))[1]
        route:kill()
        t.run_for(1)
        assert.is_true(sim.getObjectPosition(t.object('/Robot'))[1] > before + 0.2)
    end)
end)
