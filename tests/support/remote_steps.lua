-- Every order in which requests of clients can reach the ZeroMQ remote API, which runs here without sockets, clock and simulation.
-- explore(programs) lets each client send its requests one after the other: 'on', 'off' (of stepping), 'step', 'start', 'pause', 'stop',
-- 'call' (of a callback). Whatever the order, each program ends, and each step is one step.

sim = require 'sim'
local decode = require('simCBOR').decode
local encode = require('org.conman.cbor').encode

local PATIENCE <const>, FOR_EVER <const> = 0.02, 60

local REQUESTS <const> = {
    on = {func = 'sim.setStepping', args = {true}},
    off = {func = 'sim.setStepping', args = {false}},
    step = {func = 'sim.step'},
    start = {func = 'sim.startSimulation'},
    pause = {func = 'sim.pauseSimulation'},
    stop = {func = 'sim.stopSimulation'},
    call = {func = 'sim.testCB', args = {1, 'f@func', 2, 0}},
}

---------------------------------------------------------------- the simulation

local STOPPED <const>, PAUSED <const>, FIRST <const>, RUNNING <const> = 0x00, 0x08, 0x10, 0x11
local BEFORE_PAUSE <const>, AFTER_PAUSE <const>, ABOUT_TO_STOP <const>, LAST <const> = 0x13, 0x14, 0x15, 0x16

local now, state, steps, stopAsked, pauseAsked = 0.0, STOPPED, 0, false, false

function sim.getSystemTime() return now end
function sim.getSimulationState() return state end
function sim.startSimulation()
    if state == STOPPED then state, stopAsked, pauseAsked = FIRST, false, false end
    if state == PAUSED then state = AFTER_PAUSE end
end
function sim.pauseSimulation() pauseAsked = state & 0x10 ~= 0 and not stopAsked end
function sim._stopSimulation()
    if state == PAUSED then state = AFTER_PAUSE end
    if state ~= STOPPED then stopAsked, pauseAsked = true, false end
end

local function stateAfterStep()
    if state == FIRST or state == AFTER_PAUSE then return RUNNING end
    if state == RUNNING and stopAsked then return ABOUT_TO_STOP end
    if state == RUNNING and pauseAsked then return BEFORE_PAUSE end
    if state == BEFORE_PAUSE then return PAUSED end
    return state == ABOUT_TO_STOP and LAST or state
end

---------------------------------------------------------------- clients

local peers -- of this order: {program, at, message, level, asked, steps}
local taken, counts, delays -- the choices of this order, how many there were, how often nothing may still come in time
local prefix

local function choose(count)
    taken[#taken + 1] = prefix[#taken + 1] or 1
    counts[#taken] = count
    return taken[#taken]
end

local function nextRequest(peer)
    peer.at, peer.asked = peer.at + 1, nil
    peer.word = peer.program[peer.at]
    peer.message = REQUESTS[peer.word] or {func = '_*end*_'}
end

local function check(condition, what) return condition or error(what, 0) end

local function isStanding() return state & 0x10 == 0 end

local function ended(peer)
    if peer.word == 'on' then peer.level = peer.level + 1 end
    if peer.word == 'off' then peer.level = math.max(0, peer.level - 1) end
    if peer.word == 'stop' then for _, other in ipairs(peers) do other.level = 0 end end
    if peer.word ~= 'step' or steps > peer.steps then return end
    check(isStanding(), 'a step that is none')
    check(peer.level == 0 or now - peer.asked >= PATIENCE, 'a step that did not wait for the start')
end

local native = {members = function() return {} end, returns = function() end}

function native.reply(number, bytes)
    local peer, reply = peers[number], decode(bytes)
    check(not peer.message and not peer.isOver, 'an answer to nobody')
    if reply.func == '_*repeat*_' then
        peer.message = REQUESTS[peer.word]
    elseif reply.func then
        peer.message = {func = '_*executed*_', args = {}}
    else
        check(not reply.err, reply.err)
        peer.isOver = not peer.word
        if peer.isOver then return end
        ended(peer)
        nextRequest(peer)
    end
end

local function quiet(timeout)
    now = now + math.max(timeout, 0.0001)
    check(now < FOR_EVER, 'everything waits')
end

local function ready()
    local numbers = {}
    for number, peer in ipairs(peers) do
        if peer.message then numbers[#numbers + 1] = number end
    end
    return numbers
end

function native.receive(timeout)
    local numbers = ready()
    if #numbers == 0 then return quiet(timeout) end
    local choice = choose(#numbers + (delays > 0 and 1 or 0))
    local peer = peers[numbers[choice]]
    if not peer then
        delays = delays - 1
        return quiet(timeout)
    end
    if peer.word == 'step' and peer.message == REQUESTS.step then peer.asked, peer.steps = now, steps end
    local bytes = encode({uuid = peer.uuid, func = peer.message.func, args = peer.message.args})
    peer.message = nil
    return numbers[choice], bytes
end

function native.closed() return false end
function native.others() return false end

local loader = package.searchers[2]('remote.zmq')
loader('remote.zmq', native)

---------------------------------------------------------------- orders

-- Nobody who steps is overtaken.
local function advance()
    for _, peer in ipairs(peers) do
        local isAsking = peer.word == 'step' and peer.asked
        check(peer.level == 0 or isAsking or not peer.word, 'the simulation did not wait')
    end
    steps = steps + 1
    if state ~= LAST then state = stateAfterStep() return end
    state = STOPPED
    sysCall_afterSimulation()
end

local function iterate()
    if state == STOPPED then return sysCall_nonSimulation() end
    if state == PAUSED then return sysCall_suspended() end
    sysCall_actuation()
    advance()
end

local function isOver()
    for _, peer in ipairs(peers) do
        if not peer.isOver then return false end
    end
    return true
end

local function runOrder(programs, mostDelays)
    peers, taken, counts, delays, now, steps = {}, {}, {}, mostDelays, 0.0, 0
    for i, program in ipairs(programs) do
        peers[i] = {uuid = 'client ' .. i, program = program, at = 0, level = 0, steps = 0}
        nextRequest(peers[i])
    end
    while not isOver() do
        quiet(0)
        iterate()
    end
    sim._stopSimulation()
    while state ~= STOPPED do
        if state == PAUSED then sim.startSimulation() end -- a pause that had begun comes before the stop
        iterate()
    end
end

-- The choices of the next order; nothing after the last one.
local function nextPrefix()
    for i = #taken, 1, -1 do
        if taken[i] < counts[i] then
            local choices = table.move(taken, 1, i, 1, {})
            choices[i] = choices[i] + 1
            return choices
        end
    end
end

local function describe(programs)
    local words = {}
    for i, program in ipairs(programs) do words[i] = table.concat(program, ' ') end
    return table.concat(words, ' | ') .. ', order ' .. table.concat(taken, '')
end

-- How many orders there are; an error names the first that goes wrong. So often nothing comes in time although there is something.
function explore(programs, mostDelays)
    local count = 0
    prefix = {}
    while prefix do
        local ok, message = xpcall(runOrder, tostring, programs, mostDelays) -- unlike pcall, it lets requests wait
        if not ok then error(('%s: %s'):format(message, describe(programs)), 0) end
        count, prefix = count + 1, nextPrefix()
    end
    return count
end
