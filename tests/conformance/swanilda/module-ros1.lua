-- topic: modules
-- as: sandbox
-- passes: 0
-- spec: ros 4
-- note: what is refused before a master is needed
simROS = require 'simROS'

local function fails(name, ...)
    local ok, text = pcall(simROS[name], ...)
    assert(not ok, name)
    print((text:gsub('%. Folders.*', '')))
end

fails('advertise', '/a', 'no_msgs/Such')
fails('advertise', '/a', 'std_srvs/srv/SetBool')
fails('advertise', '/a', 'std_msgs')
fails('subscribe', '/a', 'std_msgs/Thing', print)
fails('subscribe', '/a', 'std_msgs/String', print, 1, {transports = {'udp'}})
fails('advertise', '/a', 'std_msgs/String', -1)
fails('serviceClient', '/a', 'std_msgs/String')
fails('advertiseService', '/a', 'std_srvs/Such', print)
fails('publish', '1:ptr', {data = 'x'})
fails('call', '', {})
for _, what in ipairs {'Publisher', 'Subscriber', 'ServiceClient', 'ServiceServer'} do
    fails('shutdown' .. what, 'ff:ptr')
    fails(what:sub(1, 1):lower() .. what:sub(2) .. 'TreatUInt8ArrayAsString', '01:ptr')
end
fails('imageTransportPublish', '1:ptr', 'abc', 1, 1, 'frame')
fails('imageTransportShutdownPublisher', '1:ptr')
fails('imageTransportShutdownSubscriber', '1:ptr')
fails('sendTransforms', {x = 1})
