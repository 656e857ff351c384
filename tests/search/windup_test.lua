-- A cart with a weak motor is driven to a place by a PI controller.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
goal, x, v, integral = 0, 0, 0, 0

function sysCall_actuation()
    local dt = sim.getSimulationTimeStep()
    local e = goal - x
    local command = 2 * e - 4 * v + 0.2 * integral
    local force = math.max(-1, math.min(1, command))
    if math.abs(command) < 1 then integral = integral + e * dt end -- right
    integral = integral + e * dt -- broken
    v = v + force * dt
    x = x + v * dt
end
]]

versions.property('the cart does not run far past its goal', { cases = 200 }, function(g, version)
    local cart = versions.script(CODE, version)
    local goal = g.float(0, 10)
    t.start()
    cart:set('goal', goal)
    t.always(function() return goal + 1 - cart:get('x') end, 'overshoot below 1 m')
    t.run_for(25)
end)
