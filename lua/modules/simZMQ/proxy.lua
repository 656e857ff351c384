--[[
The proxy of simZMQ: passes messages between two sockets, with copies to a third, and a fourth that steers it.

Written here and not left to libzmq, whose proxy takes its thread for ever, and the whole program with it when a command is unknown.
]]

-- Messages passed on in one direction before the other has its turn.
local BURST <const> = 1000
-- How long to wait for room where nothing can yield, milliseconds, before messages from elsewhere have their turn.
local POLL_TIMEOUT <const> = 10
local POLLIN <const>, POLLOUT <const>, SNDMORE <const>, RCVMORE <const> = 1, 2, 2, 13

local native, poll, pause, send -- what simZMQ gives

local function hasRoom(socket) return native.poll({socket}, {POLLOUT}, 0) == 1 end

-- Passes on one message with all its parts; false when there is none.
local function pass(state, from, to, received, sent)
    repeat
        local size = native.msg_recv(state.message, from, 0)
        if size < 0 then return false end
        local more = native.msg_more(state.message) == 1
        local flags = more and SNDMORE or 0
        native.msg_copy(state.copy, state.message)
        if send(state.copy, state.capture, flags) < 0 or send(state.message, to, flags) < 0 then
            state.failed = true
            return false
        end
        received.bytes, sent.bytes = received.bytes + size, sent.bytes + size
    until not more
    received.count, sent.count = received.count + 1, sent.count + 1
    return true
end

-- Whether anything went.
local function forward(state, from, to, received, sent)
    local passed = 0
    while passed < BURST and hasRoom(to) and pass(state, from, to, received, sent) do passed = passed + 1 end
    return passed > 0
end

local function counter() return {count = 0, bytes = 0} end

local function tellStatistics(state)
    local counters = {state.fromFront, state.toFront, state.fromBack, state.toBack}
    for i, counted in ipairs(counters) do
        native.send(state.control, ('=I8'):pack(counted.count), SNDMORE)
        native.send(state.control, ('=I8'):pack(counted.bytes), i < #counters and SNDMORE or 0)
    end
end

-- Obeys one command; unknown ones are ignored. False when it has more than one part.
local function obey(state)
    local size, command = native.recv(state.control, 0)
    if size < 0 then return true end
    local _, more = native.getsockopt(state.control, RCVMORE, 4)
    if ('=i4'):unpack(more) ~= 0 then return false end
    native.send(state.capture, command, 0)
    if command == 'PAUSE' then
        state.paused = true
    elseif command == 'RESUME' then
        state.paused = false
    elseif command == 'TERMINATE' then
        state.ended = true
    elseif command == 'STATISTICS' then
        tellStatistics(state)
    end
    return true
end

-- One round: waits for messages, and passes them on.
local function turn(state)
    local sockets, events = {}, {}
    for _, socket in ipairs(state.paused and {state.control} or {state.frontend, state.backend, state.control}) do
        sockets[#sockets + 1], events[#events + 1] = socket, POLLIN
    end
    local result, revents = poll(sockets, events, -1)
    -- Without a message the wait ends only where nothing can yield.
    if result <= 0 then return false end
    if state.control and revents[#sockets] ~= 0 and not obey(state) then return false end
    if state.paused or state.ended then return true end
    local front, back = state.frontend, state.backend
    local went = forward(state, front, back, state.fromFront, state.toBack)
    if front ~= back then went = forward(state, back, front, state.fromBack, state.toFront) or went end
    if state.failed then return false end
    -- What cannot go now waits until there is room.
    pause({front, back}, {POLLOUT, POLLOUT}, went and 0 or POLL_TIMEOUT)
    return true
end

local function proxy(frontend, backend, capture, control)
    local state = {
        frontend = frontend, backend = backend, capture = capture, control = control, message = native.msg_new(),
        copy = native.msg_new(), fromFront = counter(), toFront = counter(), fromBack = counter(), toBack = counter(),
    }
    native.msg_init(state.message)
    native.msg_init(state.copy)
    local goesOn = true
    while goesOn and not state.ended do goesOn = turn(state) end
    native.msg_destroy(state.message)
    native.msg_destroy(state.copy)
    return goesOn and 0 or -1
end

return function(given)
    native, poll, pause, send = given.native, given.poll, given.pause, given.msg_send
    return proxy
end
