--[[
Faults of sensors, messages, motors, bodies and programs: t.faults. Internal; docs/TESTING.md describes each.

Every fault takes hold at once and returns itself: f:stop() ends it. What is random in one comes from the seed of the run.
]]

local sim = require('sim')

local M = {} -- t.faults
local shown -- writes a value for people

local Fault = {}
Fault.__index = Fault

function Fault:stop()
    if not self.isActive then return end
    self.isActive = false
    if self.undo then self.undo() end
end

local function new(undo) return setmetatable({ isActive = true, undo = undo }, Fault) end

local t, Script -- the fixture, and the class of its scripts

local function asScript(script)
    return getmetatable(script) == Script and script or t.script(script)
end

local function asHandle(object) return type(object) == 'string' and sim.getObject(object) or object end

-- A fault of the calls of a function: while it is active, a call is `faulty(call, ...)`.
local function ofCalls(script, name, faulty)
    local fault = new()
    asScript(script):wrap(name, function(call, ...)
        if not fault.isActive then return call(...) end
        return faulty(call, ...)
    end)
    return fault
end

-- The results of the calls, changed: all numbers in them, or those of one result.
local function ofResults(script, name, result, changed)
    local function within(value)
        if type(value) == 'number' then return changed(value) end
        if type(value) ~= 'table' then return value end
        local values = {}
        for key, entry in pairs(value) do values[key] = within(entry) end
        return values
    end
    return ofCalls(script, name, function(call, ...)
        local results = table.pack(call(...))
        for i = 1, results.n do
            if not result or i == result then results[i] = within(results[i]) end
        end
        return table.unpack(results, 1, results.n)
    end)
end

---------------------------------------------------------------- sensors

local sensors = {}

function sensors.noise(script, name, sigma, result)
    return ofResults(script, name, result, function(value) return value + sigma * t.gauss() end)
end

function sensors.bias(script, name, offset, result)
    return ofResults(script, name, result, function(value) return value + offset end)
end

function sensors.dropout(script, name, probability, ...)
    local instead = table.pack(...)
    return ofCalls(script, name, function(call, ...)
        if math.random() < probability then return table.unpack(instead, 1, instead.n) end
        return call(...)
    end)
end

function sensors.stuck(script, name)
    local last
    return ofCalls(script, name, function(call, ...)
        last = last or table.pack(call(...))
        return table.unpack(last, 1, last.n)
    end)
end

-- Pictures are black: a string of bytes or a list of numbers becomes zeros.
function sensors.blackout(script, name)
    return ofCalls(script, name or 'sim.getVisionSensorImg', function(call, ...)
        local results = table.pack(call(...))
        local picture = results[1]
        if type(picture) == 'string' then results[1] = ('\0'):rep(#picture) end
        if type(picture) == 'table' then
            for i in ipairs(picture) do picture[i] = 0 end
        end
        return table.unpack(results, 1, results.n)
    end)
end

---------------------------------------------------------------- messages, and all that is sent by a call

local messages = {}

function messages.delay(script, name, seconds)
    return ofCalls(script, name, function(call, ...)
        local arguments = table.pack(...)
        t.at(t.time() + seconds, function() call(table.unpack(arguments, 1, arguments.n)) end)
    end)
end

function messages.lose(script, name, probability)
    return ofCalls(script, name, function(call, ...)
        if math.random() < (probability or 1) then return end
        return call(...)
    end)
end

function messages.double(script, name, probability)
    return ofCalls(script, name, function(call, ...)
        if math.random() < (probability or 1) then call(...) end
        return call(...)
    end)
end

-- A call waits until the next one was made.
function messages.reorder(script, name, probability)
    local held
    local function release(call)
        local arguments = held
        held = nil
        if arguments then call(table.unpack(arguments, 1, arguments.n)) end
    end
    local wrapped
    local fault = ofCalls(script, name, function(call, ...)
        wrapped = call
        if not held and math.random() < (probability or 1) then
            held = table.pack(...)
            return
        end
        local results = table.pack(call(...))
        release(call)
        return table.unpack(results, 1, results.n)
    end)
    fault.undo = function() if wrapped then release(wrapped) end end
    return fault
end

---------------------------------------------------------------- clients of the remote APIs

local clients = {}

local SERVERS <const> = { 'ZMQ remote API server', 'WebSocket remote API server' }

-- A fault of the link to the clients, see remote.link.
local function ofLink(kind, value)
    local begun = {}
    for _, name in ipairs(SERVERS) do
        local exists, server = pcall(sim.getScript, sim.scripttype_addon, name)
        if exists then begun[server] = sim.callScriptFunction('_swanilda_link_begin', server, kind, value) end
    end
    if not next(begun) then error(('faults.%s: there is no remote API for clients (--remote-api).'):format(kind), 3) end
    return new(function()
        for server, number in pairs(begun) do sim.callScriptFunction('_swanilda_link_end', server, kind, number) end
    end)
end

function clients.loseRequests(probability) return ofLink('loseRequests', probability or 1) end

function clients.loseReplies(probability) return ofLink('loseReplies', probability or 1) end

function clients.doubleRequests(probability) return ofLink('doubleRequests', probability or 1) end

function clients.reorderRequests(probability) return ofLink('reorderRequests', probability or 1) end

-- Seconds of the wall clock.
function clients.delayRequests(seconds) return ofLink('delayRequests', seconds) end

-- The clients that have sent a request so far are silent from now on, without ending their connections.
function clients.vanish() return ofLink('vanish') end

---------------------------------------------------------------- programs

local programs = {}

-- The function runs at every n-th call only, such as sysCall_actuation.
function programs.slow(script, name, n)
    local calls = 0
    return ofCalls(script, name, function(call, ...)
        calls = calls + 1
        if calls % n == 1 or n <= 1 then return call(...) end
    end)
end

-- The next call raises an error.
function programs.fail(script, name, message)
    local fault
    fault = ofCalls(script, name, function()
        fault.isActive = false
        error(message or (name .. ' fails.'), 0)
    end)
    return fault
end

-- The script ends as a crash would.
function programs.crash(script)
    asScript(script):kill()
    return new()
end

---------------------------------------------------------------- motors and joints

local motors = {}

-- The command `argument` of the calls loses `width` whenever it turns round.
function motors.backlash(script, name, width, argument)
    argument = argument or 2
    local output
    return ofCalls(script, name, function(call, ...)
        local arguments = table.pack(...)
        local command = arguments[argument]
        output = output or command
        output = math.max(command - width / 2, math.min(command + width / 2, output))
        arguments[argument] = output
        return call(table.unpack(arguments, 1, arguments.n))
    end)
end

function motors.weak(joint, factor)
    local handle = asHandle(joint)
    local force = sim.getJointTargetForce(handle)
    sim.setJointTargetForce(handle, force * factor)
    return new(function() sim.setJointTargetForce(handle, force) end)
end

-- The joint stays where it is.
function motors.jam(joint)
    local handle = asHandle(joint)
    local cyclic, interval = sim.getJointInterval(handle)
    sim.setJointInterval(handle, false, { sim.getJointPosition(handle), 0 })
    return new(function() sim.setJointInterval(handle, cyclic, interval) end)
end

function motors.friction(joint, force)
    -- A motor that holds still with the force of the friction; one that drives has that much less.
    local handle = asHandle(joint)
    local mode = sim.getObjectInt32Param(handle, sim.jointintparam_dynctrlmode)
    local before = sim.getJointTargetForce(handle)
    if mode == sim.jointdynctrl_free then
        sim.setObjectInt32Param(handle, sim.jointintparam_dynctrlmode, sim.jointdynctrl_velocity)
        sim.setJointTargetVelocity(handle, 0)
        sim.setJointTargetForce(handle, force)
    else
        sim.setJointTargetForce(handle, math.max(0, before - force))
    end
    return new(function()
        sim.setObjectInt32Param(handle, sim.jointintparam_dynctrlmode, mode)
        sim.setJointTargetForce(handle, before)
    end)
end

---------------------------------------------------------------- bodies

local bodies = {}

-- Mass and inertia become so many times what they were.
function bodies.mass(shape, factor)
    local handle = asHandle(shape)
    local mass = sim.getShapeMass(handle)
    local inertia, transform = sim.getShapeInertia(handle)
    local scaled = {}
    for i, entry in ipairs(inertia) do scaled[i] = entry * factor end
    sim.setShapeMass(handle, mass * factor)
    sim.setShapeInertia(handle, scaled, transform)
    return new(function()
        sim.setShapeMass(handle, mass)
        sim.setShapeInertia(handle, inertia, transform)
    end)
end

-- Its coefficient of friction becomes so many times what it was.
function bodies.slip(shape, factor)
    local handle = asHandle(shape)
    local material = sim.getFloatProperty(handle, 'bullet.friction')
    sim.setFloatProperty(handle, 'bullet.friction', material * factor)
    return new(function() sim.setFloatProperty(handle, 'bullet.friction', material) end)
end

-- A force {x, y, z} in N, in the frame of the world, for so many seconds.
function bodies.push(shape, force, seconds)
    local handle = asHandle(shape)
    local fault = new()
    local last = t.time() + (seconds or sim.getSimulationTimeStep()) - 1e-9
    local function again()
        if not fault.isActive then return end
        sim.addForceAndTorque(handle, force, { 0, 0, 0 })
        local next = t.time() + sim.getSimulationTimeStep()
        if next < last then t.at(next, again) else fault.isActive = false end
    end
    again()
    return fault
end

---------------------------------------------------------------- all

for _, group in ipairs { sensors, messages, clients, programs, motors, bodies } do
    for name, fault in pairs(group) do M[name] = fault end
end

---------------------------------------------------------------- faults that a search chooses

-- The value of a parameter of a fault: {lo, hi} is drawn.
local function drawn(g, value)
    if type(value) == 'table' and #value == 2 and type(value[1]) == 'number' and type(value[2]) == 'number' then
        return g.float(value[1], value[2])
    end
    if type(value) == 'table' and type(value.choice) == 'table' then return g.choice(value.choice) end
    return value
end

local function checkedFaults(list)
    for _, entry in ipairs(list) do
        if type(entry) ~= 'table' or not M[entry[1]] then
            error(('g.faults: %s is no fault; see t.faults.'):format(type(entry) == 'table' and tostring(entry[1]) or tostring(entry)), 3)
        end
    end
end

local Chosen = {}

function Chosen.__tostring(chosen)
    local words = {}
    for i = 1, chosen.arguments.n do words[i] = shown(chosen.arguments[i]) end
    local text = ('%s(%s) from %.6g s'):format(chosen.fault, table.concat(words, ', '), chosen.from)
    return chosen.to and ('%s to %.6g s'):format(text, chosen.to) or text
end

-- One of the list, its parameters drawn.
local function drawnFault(g, list, options)
    local entry = g.choice(list)
    local arguments = { n = #entry - 1 }
    for i = 2, #entry do arguments[i - 1] = drawn(g, entry[i]) end
    local from = t.time()
    local to = options.lasts and from + drawn(g, options.lasts)
    return setmetatable({ fault = entry[1], arguments = arguments, from = from, to = to }, Chosen)
end

local function begin(chosen)
    local fault = M[chosen.fault](table.unpack(chosen.arguments, 1, chosen.arguments.n))
    if chosen.to then t.at(chosen.to, function() fault:stop() end) end
end

--- g.faults(list, options): some of these faults, each a list of the name of one of t.faults and its arguments, of which {lo, hi} is a
-- number between and {choice = {...}} one of these. Options: most (3) of them, within: seconds in which they begin, lasts: seconds.
-- When they begin is drawn at once, which ones they are and what when they do: other cases may go on from there. Returns the list of those
-- that have begun.
local function generator(g, later)
    return function(list, options)
        options = options or {}
        checkedFaults(list)
        local line, chosen = later.line(), {}
        local begun = later.list(options.most or 3, function() return t.time() + g.float(0, options.within or 0) end)
        for _, element in ipairs(begun) do
            local function start()
                local one = later.drawn(element.span, drawnFault, g, list, options)
                chosen[#chosen + 1] = one
                later.note(line, one)
                begin(one)
            end
            if element.value <= t.time() then start() else t.at(element.value, start) end
        end
        return chosen
    end
end

--- The faults, and what makes g.faults, for that fixture with this class of scripts.
return function(fixture, scripts, write)
    t, Script, shown = fixture, scripts, write
    return M, generator
end
