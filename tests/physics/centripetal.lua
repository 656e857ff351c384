-- What goes round pulls at what holds it by m w^2 r: force sensors, joints and motors bear it, at any speed.
local bench = require 'lib.bench'

local MASS <const>, RADIUS <const> = 0.1, 0.4

-- With a threshold in newtons the sensor tells its scripts when it is exceeded.
local function sensor(at, parent, threshold)
    local options = threshold and 1 or 0
    local handle = sim.createForceSensor(options, {0, 1, 3, 0, 0}, {0.005, threshold or 0, 0, 0, 0})
    sim.setObjectPosition(handle, at)
    sim.setObjectParent(handle, parent, true)
    return handle
end

local function load(handle)
    local _, force = sim.readForceSensor(handle)
    return force and math.sqrt(force[1] ^ 2 + force[2] ^ 2 + force[3] ^ 2) or 0
end

--- A turntable about the vertical with a mass on a sensor at its edge.
local function turntable(y, speed, threshold)
    local base = bench.body{at = {0, y, 1}, fixed = true}
    local joint = bench.joint{at = {0, y, 1}, axis = 'z', parent = base, mode = sim.jointdynctrl_velocity, force = 1e4}
    sim.setJointTargetVelocity(joint, speed)
    local table = bench.body{size = {1, 0.1, 0.05}, at = {0, y, 1}, mass = 2, parent = joint}
    local held = sensor({RADIUS, y, 1}, table, threshold)
    bench.body{size = {0.01, 0.01, 0.01}, at = {RADIUS, y, 1}, mass = MASS, parent = held}
    return held
end

--- A pendulum let go level, with sensors between base and axle and in its string.
local function pendulum(y)
    local base = bench.body{at = {0, y, 2}, fixed = true}
    local above = sensor({0, y, 2}, base)
    local hub = bench.body{size = {0.02, 0.02, 0.02}, at = {0, y, 2}, mass = 1e-3, parent = above}
    local joint = bench.joint{at = {0, y, 2}, parent = hub}
    local rod = bench.body{size = {0.02, 0.02, 0.02}, at = {0.2, y, 2}, mass = 1e-3, parent = joint}
    local string = sensor({0.3, y, 2}, rod)
    bench.body{size = {0.01, 0.01, 0.01}, at = {RADIUS, y, 2}, mass = MASS, parent = string}
    return above, string
end

local SPEEDS <const> = {1, 4, 16}
local tables = {}
for index, speed in ipairs(SPEEDS) do tables[index] = turntable(index, speed) end
local above, string = pendulum(10)

-- At 4 rad/s a sensor bears 1.171 N with the weight.
local weak, strong = turntable(20, 4, 1.15), turntable(21, 4, 1.19)
local SCRIPT <const> = "sim = require 'sim' function sysCall_trigger() sim.setBoolProperty(%d, 'customData.triggered', true) end"
for _, handle in ipairs{weak, strong} do
    sim.setBoolProperty(handle, 'customData.triggered', false)
    local script = sim.createScript(sim.scripttype_simulation, SCRIPT:format(handle), 0, 'lua')
    sim.setObjectParent(script, handle, false)
    sim.initScript(script)
end

local function hasTriggered(handle) return sim.getBoolProperty(handle, 'customData.triggered') and 1 or 0 end

bench.run(function()
    local peakAbove, peakString = 0, 0
    for _ = 1, 40 do
        sim.step()
        peakAbove, peakString = math.max(peakAbove, load(above)), math.max(peakString, load(string))
    end
    for index, speed in ipairs(SPEEDS) do
        local _, force = sim.readForceSensor(tables[index])
        local pull = MASS * speed ^ 2 * RADIUS
        bench.check('mass at ' .. speed .. ' rad/s: force along the radius, N', math.sqrt(force[1] ^ 2 + force[2] ^ 2), pull, 0.005 * pull)
        bench.check('its weight, N', math.abs(force[3]), MASS * bench.g, 1e-3)
    end
    bench.check('a sensor that may bear 1.15 N at 4 rad/s: triggered', hasTriggered(weak), 1, 0)
    bench.check('one that may bear 1.19 N: triggered', hasTriggered(strong), 0, 0)
    local weight = MASS * bench.g
    bench.check('pendulum let go level: largest pull in its string, in weights', peakString / weight, 3, 0.05)
    bench.check('the same above its axle, in weights of both masses', peakAbove / weight, 3, 0.07)
end)
