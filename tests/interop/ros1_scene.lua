-- The simulator's side of ros1_peers.py: echoes topics, answers a service, calls one on request, reads and writes parameters.
sim = require 'sim'
simROS = require 'simROS'
r = simROS

-- Whether there is one, and its value.
local function value(exists, value) return tostring(exists) .. ' ' .. tostring(value) end

local function commands()
    return {
        call = function() print('sum ' .. r.call(adder, {data = true}).message) end,
        no_service = function() print('failed ' .. select(2, pcall(r.call, lost, {}))) end,
        parameters = function()
            print('parameters', value(r.getParamInt('/number')), value(r.getParamDouble('/number')), value(r.getParamString('/text')), value(r.getParamBool('/truth')))
            print('wrong', value(r.getParamInt('/text', 7)), value(r.getParamString('/nothing', 'else')), r.hasParam('/nothing'))
            r.setParamDouble('~gain', 0.1)
            r.setParamBool('/own/truth', true)
            r.setParamInt('/own/integer', -3)
            r.setParamString('/own/text', 'a <b> & c')
            print('found', value(r.searchParam('gain')), value(r.searchParam('nowhere')))
            r.deleteParam('/number')
            r.deleteParam('/number')
        end,
        transforms = function()
            local t = {header = {stamp = 12.25, frame_id = 'world'}, child_frame_id = 'base', transform = {translation = {x = 1, y = 2, z = 3}, rotation = {w = 1}}}
            r.sendTransform(t)
            r.sendTransforms({t, t})
        end,
        leave = function()
            r.shutdownPublisher(back)
            r.shutdownSubscriber(there)
            r.shutdownServiceServer(set)
            print('left ' .. tostring(pcall(r.publish, back, {data = 'x'})))
        end,
        time = function() print('time ' .. r.getTime()) end,
        block = function()
            -- Nothing is read meanwhile.
            local stop = sim.getSystemTime() + 1
            count, newest = 0, nil
            while sim.getSystemTime() < stop do end
            blocked = true
        end,
        fail = function() error('on purpose') end,
    }
end

function sysCall_init()
    local callbacks = commands()
    r.subscribe('/command', 'std_msgs/String', function(m) callbacks[m.data]() end, 10)
    back = r.advertise('/back', 'std_msgs/String', 100)
    there = r.subscribe('/there', 'std_msgs/String', function(m) r.publish(back, m) end, 100)
    latched = r.advertise('/latched', 'std_msgs/Int64', 1, true)
    for n = 1, 3 do r.publish(latched, {data = n}) end
    scans = r.advertise('scan', 'sensor_msgs/LaserScan')
    r.subscribe('/flood', 'std_msgs/Int32', function(m) count = (count or 0) + 1 newest = m.data end, 5)
    r.setParamString('/image/compressed/format', 'png')
    images = r.imageTransportAdvertise('/image')
    r.imageTransportSubscribe('/picture_again/compressed', function(data, w, h) print('again', tostring(data), w, h) end)
    r.imageTransportSubscribe('/picture', function(data, w, h) print('picture', sim.unpackUInt8Table(data)[1], #data, w, h) end)
    bytes = r.advertise('/bytes', 'std_msgs/UInt8MultiArray')
    r.publisherTreatUInt8ArrayAsString(bytes)
    set = r.advertiseService('/set', 'std_srvs/SetBool', 'answer')
    adder = r.serviceClient('/ask', 'std_srvs/SetBool')
    lost = r.serviceClient('/lost', 'std_srvs/Empty')
    own = r.serviceClient('/set', 'std_srvs/SetBool')
    print('own ' .. r.call(own, {data = true}).message)
    r.subscribe('/wrong_type', 'std_msgs/Int32', function() print('never') end)
    print('ready')
end

function answer(request) return {success = not request.data, message = 'answered ' .. tostring(request.data)} end

function sysCall_actuation()
    r.publish(scans, {header = {stamp = sim.getSimulationTime(), frame_id = 'laser'}, ranges = {1, 2.5, sim.getSimulationTime()}})
    r.imageTransportPublish(images, '123456789abcdefghi', 2, 3, 'camera')
    r.publish(bytes, {data = '\0\1\255'})
    if blocked and newest then
        print('flood ' .. count .. ' ' .. newest)
        blocked = nil
    end
end
