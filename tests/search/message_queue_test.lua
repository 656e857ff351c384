-- Commands wait in a ring of four places.

local sim = require('sim')
local t = require('swanilda.test')
local versions = require('versions')

local CODE <const> = [[
sim = require 'sim'
ring, first, count, done, refused = {}, 1, 0, {}, 0

function command(number)
    if count == 4 then refused = refused + 1 return end -- right
    if count > 4 then refused = refused + 1 return end -- broken
    ring[(first + count - 1) % 4 + 1] = number
    count = count + 1
end

function sysCall_actuation()
    if count == 0 then return end
    done[#done + 1] = ring[first]
    first, count = first % 4 + 1, count - 1
end
]]

versions.property('commands are done once and in order', { cases = 200 }, function(g, version)
    local robot = versions.script(CODE, version)
    t.start()
    local number = 0
    for _, burst in ipairs(g.list(function() return g.integer(0, 6) end, { max = 6 })) do
        for _ = 1, burst do
            number = number + 1
            robot:call('command', number)
        end
        t.step()
    end
    t.step(8)
    local last = 0
    for _, one in ipairs(robot:get('done')) do
        assert.is_true(one > last, ('command %d follows command %d'):format(one, last))
        last = one
    end
end)
