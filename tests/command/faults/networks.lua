-- Sends the numbers 1 to 6 to itself by ZeroMQ, WebSocket and ROS 2 once faults have begun, and prints what has arrived.
sim = require 'sim'
simZMQ = require 'simZMQ'
simWS = require 'simWS'
simROS2 = require 'simROS2'

local LAST <const> = 6
local received = { zmq = {}, ws = {}, ros = {} }
local sent = 0
local push, pull, client, connection, publisher

local function receive(network, number)
    table.insert(received[network], number)
end

function onNumber(message) receive('ros', message.data) end

function sysCall_init()
    local context = simZMQ.ctx_new()
    push, pull = simZMQ.socket(context, simZMQ.PUSH), simZMQ.socket(context, simZMQ.PULL)
    simZMQ.bind(push, 'inproc://numbers')
    simZMQ.connect(pull, 'inproc://numbers')
    local server = simWS.start(0)
    simWS.setMessageHandler(server, function(_, _, data) receive('ws', tostring(data)) end)
    client = simWS.connect('ws://127.0.0.1:' .. simWS.getPort(server))
    simWS.setOpenHandler(client, function(_, opened) connection = opened end)
    publisher = simROS2.createPublisher('/numbers', 'std_msgs/msg/Int32')
    simROS2.createSubscription('/numbers', 'std_msgs/msg/Int32', 'onNumber')
end

local function receiveAll()
    repeat
        local result, message = simZMQ.recv(pull, simZMQ.DONTWAIT)
        if result >= 0 then receive('zmq', tostring(message)) end
    until result < 0
end

function sysCall_actuation()
    if not connection or sim.getSimulationTime() < 0.2 or sent == LAST then return end
    sent = sent + 1
    simZMQ.send(push, tostring(sent), 0)
    simWS.send(client, connection, tostring(sent))
    simROS2.publish(publisher, { data = sent })
end

-- By the wall clock, since networks have their own.
function sysCall_sensing()
    receiveAll()
    if sent < LAST then begun = sim.getSystemTime() end
    if sim.getSystemTime() > begun + 1 then sim.stopSimulation() end
end

function sysCall_afterSimulation()
    for _, network in ipairs { 'zmq', 'ws', 'ros' } do print(network .. ' ' .. table.concat(received[network], ' ')) end
end
