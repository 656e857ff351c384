-- A robot goes to its charger when the battery is low, and back to work when it is full enough.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
level, draw, isCharging, switches = 0.9, 0.02, false, 0

local function set(charging)
    if charging ~= isCharging then switches = switches + 1 end
    isCharging = charging
end

function sysCall_actuation()
    level = math.max(0, math.min(1, level + (isCharging and 0.01 or -draw)))
    if level < 0.3 then set(true) elseif level > 0.8 then set(false) end -- right
    set(level < 0.3) -- broken
end
]]

versions.property('it does not go back and forth', { cases = 100 }, function(g, version)
    local robot = versions.script(CODE, version)
    t.start()
    robot:set('level', g.float(0.5, 1, 0.9))
    robot:set('draw', g.float(0.0005, 0.02, 0.001))
    t.always(function() return 12 - robot:get('switches') end, 'few changes')
    t.run_for(15)
end)
