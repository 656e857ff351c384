--[[
Fetches a URL and prints what comes:

    swanilda run scenes/fetch_url.lua -D url=https://example.org/

A request blocks the simulation until it is answered. Without a URL the scene shows how to do without blocking: it serves a page at a
free port and fetches that, a little in each step.
]]

sim = require 'sim'
local http = require 'socket.http'
local socket = require 'socket'

local PAGE = 'HTTP/1.0 200 OK\r\nContent-Type: text/plain\r\n\r\nGreetings from step %d.\n'
local server, client, request, answer

function sysCall_init()
    local url = sim.getNamedStringParam('url')
    if url then return fetch(url) end
    server = assert(socket.bind('127.0.0.1', 0))
    server:settimeout(0)
end

function fetch(url)
    local body, code, headers, status = http.request(url)
    if not body then
        print(('%s: %s'):format(url, code))
        return
    end
    print(status)
    for name, value in pairs(headers) do print(('%s: %s'):format(name, value)) end
    print(('%d bytes, which begin:\n%s'):format(#body, body:sub(1, 500)))
end

function sysCall_actuation()
    if server then serve() else sim.stopSimulation() end
end

-- Answers one client, if there is one.
function serve()
    local peer = server:accept()
    if not peer then return end
    peer:settimeout(1)
    if peer:receive('*l') then peer:send(PAGE:format(sim.getSimulationTime() / sim.getSimulationTimeStep())) end
    peer:close()
end

function sysCall_sensing()
    if not server or answer and not client then return end
    if not client then return ask() end
    -- What has arrived by now.
    local rest, reason, part = client:receive('*a')
    answer = answer .. (rest or part)
    if reason == 'timeout' then return end
    client:close()
    client = nil
    print(answer)
    sim.stopSimulation()
end

function ask()
    local _, port = server:getsockname()
    client = assert(socket.connect('127.0.0.1', port))
    client:settimeout(0)
    client:send('GET / HTTP/1.0\r\n\r\n')
    answer = ''
end

function sysCall_cleanup()
    if server then server:close() end
end
