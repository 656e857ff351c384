-- Every scene of the folder that ends by itself does what it says.
local t = require 'swanilda.test'

local function lastLine()
    local lines = t.prints()
    return lines[#lines]
end

local function runToEnd(scene, limit)
    t.load('../' .. scene)
    t.run_to_end(limit)
end

describe('the scene', function()
    it('hello says hello, and all is where it began', function()
        runToEnd('hello.lua', 5)
        assert.equal('The simulation has ended, and all is where it began: (0.00, 0.00)', lastLine())
    end)

    it('falling_boxes comes to rest', function()
        runToEnd('falling_boxes.lua', 5)
        assert.equal('8 of 8 boxes lie still.', lastLine())
    end)

    it('conveyor delivers its parcels', function()
        runToEnd('conveyor.lua', 40)
        assert.equal('5 parcels delivered.', lastLine())
    end)

    it('arm_7dof follows its motion', function()
        runToEnd('arm_7dof.lua', 10)
        local worst = tonumber(lastLine():match('Worst tracking error: ([%d.]+) deg'))
        assert.is_true(worst < 15)
    end)

    it('ik_arm stays on its target', function()
        runToEnd('ik_arm.lua', 10)
        local worst = tonumber(lastLine():match('largest error after the first second: ([%d.]+) mm'))
        assert.is_true(worst < 0.5)
        local all = t.prints()
        assert.is_truthy(all[#all - 1]:match('missed 0 times'))
    end)

    it('pick_and_place sets its boxes down behind the wall and touches nothing', function()
        runToEnd('pick_and_place.lua', 60)
        local placed, worst, touches = lastLine():match('^(%d) of 3 boxes placed within ([%d.]+) mm; the arm has touched something in (%d+) steps.$')
        assert.equal('3', placed)
        assert.is_true(tonumber(worst) < 1)
        assert.equal('0', touches)
    end)

    it('cable lies in its clips, and the connector in its socket', function()
        runToEnd('cable.lua', 60)
        local all = t.prints()
        for i = 1, 2 do
            local distance, height = all[#all - 3 + i]:match('is (%d+) mm from its middle, (%d+) mm above')
            assert.is_true(tonumber(distance) < 16 and tonumber(height) < 50)
        end
        local off, force = lastLine():match('is ([%d.]+) mm from its place in the socket; the cable pulls with ([%d.]+) N')
        assert.is_true(tonumber(off) < 3 and tonumber(force) < 20)
    end)

    it('lidar measures a room', function()
        runToEnd('lidar.lua', 1)
        assert.equal('180 of 180 beams ended; the nearest after 0.92 m, at 206 degrees.', lastLine())
    end)

    it('line_follower stays on its line', function()
        runToEnd('line_follower.lua', 40)
        local worst = tonumber(lastLine():match('One lap in [%d.]+ s, never further than ([%d.]+) cm'))
        assert.is_true(worst < 2)
    end)

    it('camera sees everything from all sides', function()
        t.load('../camera.lua')
        t.image('/Camera', {name = 'still_life'})
        t.run_to_end(1)
        local lines = t.prints()
        assert.equal(4, #lines)
        for i, line in ipairs(lines) do assert.equal('picture ' .. i .. ': nearest point at 1.32 m, 7 objects seen', line) end
    end)

    it('inverted_pendulum keeps the pole up', function()
        runToEnd('inverted_pendulum.lua', 12)
        assert.equal('The pole stands.', lastLine())
    end)
end)
