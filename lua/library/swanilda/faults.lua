--[[
Faults in a run, as tests have them (docs/TESTING.md): the file of `swanilda run --faults FILE` is the body of a function that is called after
the first step of each simulation, when all scripts have begun. It finds

    faults      the functions of t.faults: faults.noise('/robot/script', 'sim.readProximitySensor', 0.02)
    at(time, fn)    calls a function when the simulation reaches that time
    sim

An add-on can do the same: require('swanilda.faults')(function() faults.push('/robot', {20, 0, 0}, 0.2) end)
]]

local sim = require('sim')
local Script = require('swanilda.test.scripts')
local properties = require('swanilda.test.properties')

local fixture = {}
local scheduled = {} -- { time, fn }

function fixture.time() return sim.getSimulationTime() end

function fixture.gauss()
    return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
end

function fixture.script(script)
    local handle = type(script) == 'string' and sim.getObject(script) or script
    return setmetatable({ handle = handle, wrapped = {} }, Script)
end

function fixture.at(time, fn) scheduled[#scheduled + 1] = { time = time, fn = fn } end

function Script.kill() error('faults.crash: a script can be made to crash in tests only.', 3) end

local function runScheduled()
    local due = {}
    for i = #scheduled, 1, -1 do
        -- Time is a sum of steps, so it may fall short of a round number by its rounding errors.
        if scheduled[i].time <= fixture.time() * (1 + 1e-12) then table.insert(due, 1, table.remove(scheduled, i)) end
    end
    for _, one in ipairs(due) do one.fn() end
end

local faults = require('swanilda.test.faults')(fixture, Script, properties.shown)

-- @api swanilda.faults(func body)
return function(body)
    local hasBegun
    local environment = _G
    environment.faults, environment.at, environment.sim = faults, fixture.at, sim

    function environment.sysCall_beforeSimulation() hasBegun, scheduled = false, {} end

    function environment.sysCall_sensing()
        if not hasBegun then
            hasBegun = true
            body()
        end
        runScheduled()
    end
end
