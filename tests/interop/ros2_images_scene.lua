-- The simulator's side of ros2_images.py: publishes a picture, says what pictures it gets, and changes the compression on request.
sim = require 'sim'
simROS2 = require 'simROS2'
local WIDTH <const>, HEIGHT <const> = 64, 48

-- The lowest row first: red grows to the right, green upwards.
local function picture()
    local pixels = {}
    for y = 0, HEIGHT - 1 do
        for x = 0, WIDTH - 1 do pixels[#pixels + 1] = string.char(x * 4, y * 5, 30) end
    end
    return table.concat(pixels)
end

function sysCall_init()
    data = picture()
    camera = simROS2.imageTransportCreatePublisher('/front/camera')
    simROS2.createSubscription('/format', 'std_msgs/msg/String', function(message)
        simROS2.setParamString('front.camera.compressed.format', message.data)
    end)
    simROS2.imageTransportCreateSubscription('/picture/compressed', function(rgb, width, height)
        print(('picture %d %d %d %d %d %d'):format(#rgb, width, height, rgb:byte(-3), rgb:byte(-2), rgb:byte(-1)))
    end, 10)
    print('ready')
end

function sysCall_actuation() simROS2.imageTransportPublish(camera, data, WIDTH, HEIGHT, 'lens') end
