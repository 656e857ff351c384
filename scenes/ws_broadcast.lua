--[[
A robot that drives a figure of eight, and a page that shows it live. The scene serves the page itself, at the port of its messages.

    swanilda run scenes/ws_broadcast.lua --realtime
    swanilda run scenes/ws_broadcast.lua --realtime -D port=9000

Then open the address it prints in one browser or in many.
]]

sim = require 'sim'
simWS = require 'simWS'

local PAGE = [[
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<title>A robot</title>
<style>body { font: 16px sans-serif; margin: 2em } canvas { border: 1px solid #ccc; max-width: 100% }</style>
<h1>A robot</h1>
<p id="state">connecting</p>
<canvas id="map" width="600" height="400"></canvas>
<script>
const map = document.getElementById('map').getContext('2d');
const METRE = 120; // pixels
const trail = [];

function draw({x, y, heading}) {
    trail.push([x, y]);
    if (trail.length > 200) trail.shift();
    map.setTransform(1, 0, 0, 1, 0, 0);
    map.clearRect(0, 0, 600, 400);
    map.setTransform(METRE, 0, 0, -METRE, 300, 200); // metres, y upwards
    map.lineWidth = 0.01;
    map.strokeStyle = '#8ac';
    map.beginPath();
    for (const [a, b] of trail) map.lineTo(a, b);
    map.stroke();
    map.translate(x, y);
    map.rotate(heading);
    map.fillStyle = '#357';
    map.fillRect(-0.15, -0.1, 0.3, 0.2);
    map.fillStyle = '#fc3';
    map.fillRect(0.1, -0.03, 0.05, 0.06);
}

const socket = new WebSocket('ws://' + location.host + '/');
socket.onmessage = event => {
    const robot = JSON.parse(event.data);
    draw(robot);
    document.getElementById('state').textContent =
        `t = ${robot.time.toFixed(2)} s   x = ${robot.x.toFixed(2)} m   y = ${robot.y.toFixed(2)} m`;
};
socket.onclose = () => { document.getElementById('state').textContent = 'The simulation has ended.'; };
</script>
</html>
]]

local robot, server
local connections = {}

local function drive(time)
    local x, y = 1.6 * math.sin(time / 2), 0.8 * math.sin(time)
    local heading = math.atan(0.8 * math.cos(time), 0.8 * math.cos(time / 2))
    sim.setObjectPosition(robot, {x, y, 0.05})
    sim.setObjectOrientation(robot, {0, 0, heading})
end

function onOpen(_, connection) connections[#connections + 1] = connection end

function onClose(_, connection)
    for i = #connections, 1, -1 do
        if connections[i] == connection then table.remove(connections, i) end
    end
end

function onRequest(_, _, resource)
    if resource == '/' then return 200, PAGE end
    return 404, ''
end

function sysCall_init()
    robot = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.3, 0.2, 0.1})
    sim.setObjectAlias(robot, 'Robot')
    server = simWS.start(tonumber(sim.getNamedStringParam('port') or 8080))
    simWS.setOpenHandler(server, 'onOpen')
    simWS.setCloseHandler(server, 'onClose')
    simWS.setHTTPHandler(server, 'onRequest')
    print(('http://127.0.0.1:%d/'):format(simWS.getPort(server)))
end

function sysCall_actuation() drive(sim.getSimulationTime()) end

function sysCall_sensing()
    local p, heading = sim.getObjectPosition(robot), sim.getObjectOrientation(robot)[3]
    local message = ('{"time": %.3f, "x": %.4f, "y": %.4f, "heading": %.4f}'):format(sim.getSimulationTime(), p[1], p[2], heading)
    for _, connection in ipairs(connections) do
        pcall(simWS.send, server, connection, message) -- it may have gone a moment ago, or be too slow
    end
end
