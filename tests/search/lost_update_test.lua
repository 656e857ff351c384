-- A thread and a callback count items in the same variable.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
stock, made, arrivals = 0, 0, {}

function sysCall_thread()
    for _ = 1, 10 do
        local before = stock -- broken
        sim.wait(0.2)
        stock = stock + 1 -- right
        stock = before + 1 -- broken
        made = made + 1
    end
end

function sysCall_actuation()
    if arrivals[1] and sim.getSimulationTime() >= arrivals[1] then
        table.remove(arrivals, 1)
        stock = stock + 1
        made = made + 1
    end
end
]]

versions.property('the stock is what was made', { cases = 100 }, function(g, version)
    local store = versions.script(CODE, version)
    local arrivals = g.list(function() return g.float(0, 2) end, { max = 4 })
    table.sort(arrivals)
    t.start()
    store:set('arrivals', arrivals)
    t.run_for(3)
    assert.are.equal(store:get('made'), store:get('stock'))
end)
