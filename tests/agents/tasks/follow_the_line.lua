-- A controller for a robot that is there: from what its sensors see to its wheels.
local file = assert(io.open('scenes/line_follower.lua'))
local scene = file:read('a')
file:close()
-- The robot as it is, without its controller.
scene = scene:gsub('local CONTROLLER = %[%[.-%]%]', "local CONTROLLER = ''")

return {
    task = 'The robot /Body has two motors, and three eyes that look at the floor. Write a controller so that it follows the black line.',
    scene = scene,
    solve = function(call)
        local eyes = call('find_objects', {type = 'vision sensor', pattern = '*Eye'}).values.objects
        assert(#eyes == 3)
        local body = eyes[1].path:match('^(.*)/[^/]*$')
        call('write_script', {parent = body, alias = 'Follower', code = [[
sim = require 'sim'

function sysCall_init()
    left, right = sim.getObject('../LeftMotor'), sim.getObject('../RightMotor')
    leftEye, middleEye, rightEye = sim.getObject('../LeftEye'), sim.getObject('../MiddleEye'), sim.getObject('../RightEye')
    turn = 0
end

local function isDark(eye)
    local result, packet = sim.readVisionSensor(eye)
    return result >= 0 and packet[11] < 0.5
end

function sysCall_actuation()
    if isDark(leftEye) then turn = 1 elseif isDark(rightEye) then turn = -1 elseif isDark(middleEye) then turn = 0 end
    local speed = turn == 0 and 5 or 3
    sim.setJointTargetVelocity(left, speed - 4 * turn)
    sim.setJointTargetVelocity(right, speed + 4 * turn)
end
]]})
    end,
    check = function(call)
        -- Along the line, whose radius is 0.8 + 0.1 cos 3a, and on it.
        local eye = call('find_objects', {pattern = '*MiddleEye'}).values.objects[1].path
        local rows = call('run_until', {time = 15, watch = {eye .. '.position'}, every = 0.25, rows = 60}).values.samples.rows
        local passed, last = 0, nil
        for _, row in ipairs(rows) do
            local angle = math.atan(row[3], row[2])
            local off = math.abs(math.sqrt(row[2] ^ 2 + row[3] ^ 2) - 0.8 - 0.1 * math.cos(3 * angle))
            if off > 0.1 then return string.format('it is %g m beside the line at %g s', off, row[1]) end
            if last then passed = passed + math.abs((angle - last + math.pi) % (2 * math.pi) - math.pi) end
            last = angle
        end
        if passed < 2 then return 'it came only ' .. passed .. ' rad far' end
    end,
}
