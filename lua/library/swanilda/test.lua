--[[
The fixture of tests of robots: `local t = require 'swanilda.test'`. It works in files that `swanilda test` runs, where each test has a
fresh simulator with the default scene.

Scene
    t.load(file)                a scene (.lua, .ttt, a folder made by unpack) or a model (.ttm), named from the folder of the test; returns
                                what sim.loadScene or sim.loadModel does
    t.object(path)              the handle of an object
    t.file(name)                the name of a file beside the test, for io.open and the like
    t.script(path or handle)    a script of the scene, see below

Time
    t.step(n = 1)               simulation steps; starts the simulation if need be. Returns how many there were: fewer when the scene ends
                                it, which t.start() and t.stop() make forgotten
    t.run_for(seconds)          steps for that simulated time
    t.run_to_end(timeout = 60)  steps until the scene ends the simulation. Returns the time of the end
    t.run_until(condition, timeout = 10)    steps until the function returns true; fails after that simulated time. Returns the time
    t.at(time, fn)              calls a function when the simulation reaches that time
    t.start(), t.stop(), t.time()
    t.branch(fn, ...)           calls fn(...), and undoes all it did: scene, scripts, physics, random numbers, and variables of the test are as
                                before. Returns what fn returned: plain values. What it printed stays; what it wrote to files too
    t.hash()                    hash of the state that scripts can observe, a text: the same after the same steps of the same scene

Runs of their own
    t.run(file, options)        runs a scene or a script as `swanilda run` does, in another simulator, to its end. Returns output (one text),
                                lines (as t.lines has them), errors (how many), steps, time, params (named parameters at its end). Options:
                                as ('customization', 'simulation', 'sandbox', 'addon', 'main'), empty, steps, time, start (true), loops (20,
                                without a start), seed, params

Scripts: s = t.script('/Robot/controller')
    s:call(name, ...)           calls a function; s:get(expression), s:set(name, value), s:run(code)
    s:wrap(name, fn)            every call of that function (`sim.getJointPosition`, or a global) becomes fn(call, ...) in the test;
                                call(...) does what the function did. s:unwrap(name) ends it
    s:stub(name, ...)           the function returns these values; s:spy(name) lets it be. Both return a spy of luassert
    s:kill()                    ends the script as a crash would

Windows of scripts (simUI): w = t.ui('Title')
    w:click(widget)             a button, radio button or check box
    w:set(widget, value)        a slider, spin box, edit, check box, combo box (index or text), tabs; w:value(widget) reads it
    w:enter(widget, text)       sets an edit and ends editing with return
    w:select(widget, ...)       a row and a column of a table, an item of a tree; w:cell(widget, row, column, text) changes a cell
    w:link(widget, href), w:key(widget, key, text), w:close(), w:title(), w:is_open(), w:is_enabled(widget), w:is_visible(widget), w:id(widget)
                                Widgets are named by their id, the name of their id (`id="${speed}"`), their text, the label before them, or the function
                                they call. Handlers run at once
    t.answer(dialog, value)     the answer to the next dialog: 'msgBox' ('ok', 'yes', 'no', 'cancel'), 'fileDialog' (a path, or a list), 'colorDialog'
                                ({r, g, b}), 'inputDialog' (a text); false cancels
    t.dialogs()                 the dialogs that were shown: kind, title, text, answer

Messages and logs
    t.signal(name[, value])     reads or sends a signal: a number, a whole number or a string; false clears it
    t.message(data)             broadcasts a message (sysCall_msg)
    t.lines(), t.prints(), t.logs(pattern)      what was printed (print, io.write) and logged: text, level, time, origin
    t.allow_script_errors()     errors of scripts do not end the test

Faults, from the seed of the run
    t.faults.noise(script, name, sigma[, result])       numbers a function returns become noisy; result: which one
    t.faults.dropout(script, name, probability, ...)    calls fail now and then: they return the values given
    t.faults.delay(script, name, seconds)               calls take effect later, such as sim.setFloatSignal; they return nothing
    t.faults.friction(joint, force)                     friction in a joint, N or Nm
    t.random(), t.gauss()

Recordings
    t.golden(name, quantities, tolerances)      records quantities at each step from now on; at the end of the test they are compared with
                                                the file beside the test. See docs/TESTING.md
    t.image(sensor, options)                    compares what a vision sensor or camera sees with the picture beside the test
]]

local _, native = ...
local sim = require('sim')
local recorder = require('swanilda.test.recordings')
local Script = require('swanilda.test.scripts')

local t = { faults = {} }

local scheduled = {} -- { time, fn }, by time
local recordings = {}
local allowErrors = false
local seenLines = 0

if not native.isTest() then error("swanilda.test works in tests only: run the file with 'swanilda test'.", 2) end

---------------------------------------------------------------- scene

local folder = native.file():match('^(.*[/\\])') or ''

local function located(file)
    if file:find('^[/\\]') or file:find('^%a:[/\\]') then return file end
    return folder .. file
end

local hasRun = false -- the simulation was started; when it stands still, somebody has ended it

local function loaded(result)
    hasRun = false
    if not allowErrors then t._checkErrors() end
    return result
end

-- @api swanilda.test.load(string file)
function t.load(file)
    local name = located(file)
    if name:find('%.ttm$') or name:find('%.simmodel%.xml$') then return loaded(sim.loadModel(name)) end
    return loaded(sim.loadScene(name))
end

-- @api int handle = swanilda.test.object(string path)
function t.object(path) return sim.getObject(path) end

-- @api string path = swanilda.test.file(string name)
function t.file(name) return located(name) end

-- @api table result = swanilda.test.run(string file, table options = {})
function t.run(file, options) return native.run(located(file), options) end

---------------------------------------------------------------- time

-- An uncaught error ends the test, unless allowed.
local knownErrors = 0
function t._checkErrors()
    local errors = native.errors()
    if errors == knownErrors then return end
    knownErrors = errors
    local lines = native.lines(seenLines)
    seenLines = seenLines + #lines
    if allowErrors then return end
    for _, line in ipairs(lines) do
        if line.level == 'error' and line.origin then
            -- The traceback stays in the console.
            local text = line.text:gsub('\nstack traceback:.*', '')
            local message = ('script %s raised an error: %s'):format(line.origin, text)
            error({ message = message, script = line.origin }, 0)
        end
    end
    error('a script raised an error.', 0)
end

-- @api swanilda.test.allow_script_errors(bool allowed = true)
function t.allow_script_errors(allowed) allowErrors = allowed ~= false end

-- @api float time = swanilda.test.time()
function t.time() return sim.getSimulationTime() end

function t.hash() return native.hash() end

-- @api ... = swanilda.test.branch(func fn, ...)
function t.branch(fn, ...)
    local args = table.pack(...)
    -- Errors keep their values: tables of luassert, for example.
    local results, failure = native.branch(function()
        local outcome = table.pack(pcall(fn, table.unpack(args, 1, args.n)))
        if not outcome[1] and type(outcome[2]) ~= 'table' then outcome[2] = tostring(outcome[2]) end
        return outcome.n, table.unpack(outcome, 1, outcome.n)
    end)
    -- What it has printed was seen.
    seenLines = seenLines + #native.lines(seenLines)
    if failure then error(failure, 2) end
    if not results[2] then error(results[3], 0) end
    return table.unpack(results, 3, results[1] + 1)
end

local function isAdvancing() return sim.getSimulationState() & sim.simulation_advancing ~= 0 end

-- @api swanilda.test.start()
function t.start()
    hasRun = true
    if sim.getSimulationState() == sim.simulation_stopped then
        sim.startSimulation()
        native.iterate()
        t._checkErrors()
    end
end

-- @api swanilda.test.stop()
function t.stop()
    hasRun = false
    if sim.getSimulationState() == sim.simulation_stopped then return end
    sim.stopSimulation()
    while sim.getSimulationState() ~= sim.simulation_stopped do
        native.iterate()
        t._checkErrors()
    end
end

local function runScheduled()
    -- Time is a sum of steps, so it may fall short of a round number by its rounding errors.
    while scheduled[1] and scheduled[1].time <= t.time() * (1 + 1e-12) do table.remove(scheduled, 1).fn() end
end

local function sample()
    for _, recording in ipairs(recordings) do recording:sample() end
end

-- One step; false when the simulation has ended.
local function step()
    if sim.getSimulationState() == sim.simulation_stopped and not hasRun then
        hasRun = true
        sim.startSimulation()
        sample()
    end
    if not isAdvancing() then return false end
    if t.time() > native.timeLimit() then
        error(('the test has simulated for more than %g s (--sim-timeout).'):format(native.timeLimit()), 0)
    end
    runScheduled()
    native.iterate()
    t._checkErrors()
    sample()
    return true
end

-- @api int made = swanilda.test.step(int count = 1)
function t.step(count)
    for made = 1, count or 1 do
        if not step() then return made - 1 end
    end
    return count or 1
end

-- @api int made = swanilda.test.run_for(float seconds)
function t.run_for(seconds) return t.step(math.ceil(seconds / sim.getSimulationTimeStep() - 1e-9)) end

-- @api float time = swanilda.test.run_until(func condition, float timeout = 10)
function t.run_until(condition, timeout)
    timeout = timeout or 10
    local begin = t.time()
    while not condition() do
        if t.time() - begin >= timeout then
            error({ message = ('the condition was not met within %g s.'):format(timeout), failed = true })
        elseif not step() then
            error({ message = 'the simulation ended before the condition was met.', failed = true })
        end
    end
    return t.time()
end

-- @api float time = swanilda.test.run_to_end(float timeout = 60)
function t.run_to_end(timeout)
    timeout = timeout or 60
    local last = t.time()
    while step() do
        if t.time() > last then last = t.time() end
        if last > timeout then
            error({ message = ('the scene has not ended the simulation within %g s.'):format(timeout), failed = true })
        end
    end
    return last
end

-- @api swanilda.test.at(float time, func fn)
function t.at(time, fn)
    local place = #scheduled + 1
    while place > 1 and scheduled[place - 1].time > time do place = place - 1 end
    table.insert(scheduled, place, { time = time, fn = fn })
end

---------------------------------------------------------------- scripts

-- @api table script = swanilda.test.script(any script)
function t.script(script)
    local handle = type(script) == 'string' and sim.getObject(script) or script
    return setmetatable({ handle = handle, wrapped = {} }, Script)
end

function Script:kill() native.kill(self.handle) end

---------------------------------------------------------------- windows of scripts

local windows = require('swanilda.test.windows')

function t.ui(title) return windows.find(native, title, t._checkErrors) end

function t.answer(dialog, value)
    local ok, reason = pcall(native.answer, dialog, value)
    if not ok then error(windows.reason(reason), 2) end
end

function t.dialogs() return native.dialogs() end

---------------------------------------------------------------- messages and logs

-- @api any value = swanilda.test.signal(string name, ...)
function t.signal(name, ...)
    if select('#', ...) == 0 then
        return sim.getFloatSignal(name) or sim.getInt32Signal(name) or sim.getStringSignal(name)
    end
    local value = ...
    if value == false or value == nil then
        for _, kind in ipairs { 'Float', 'Int32', 'String' } do sim['clear' .. kind .. 'Signal'](name) end
    elseif math.type(value) == 'integer' then
        sim.setInt32Signal(name, value)
    elseif math.type(value) == 'float' then
        sim.setFloatSignal(name, value)
    else
        sim.setStringSignal(name, value)
    end
end

-- @api swanilda.test.message(any data, table options = nil)
function t.message(data, options) return sim.broadcastMsg(data, options) end

function t.lines() return native.lines(0, true) end

-- @api table prints = swanilda.test.prints()
function t.prints()
    local texts = {}
    for _, line in ipairs(t.lines()) do
        if line.level == 'print' then texts[#texts + 1] = line.text end
    end
    return texts
end

-- @api table lines = swanilda.test.logs(string pattern = nil)
function t.logs(pattern)
    local found = {}
    for _, line in ipairs(native.lines()) do
        if line.origin and (not pattern or line.text:find(pattern)) then found[#found + 1] = line end
    end
    return found
end

---------------------------------------------------------------- faults

-- @api float number = swanilda.test.random()
function t.random() return math.random() end

-- A number of the standard normal distribution, by the method of Box and Muller.
-- @api float number = swanilda.test.gauss()
function t.gauss()
    return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
end

local function asScript(script)
    return getmetatable(script) == Script and script or t.script(script)
end

local function noisy(value, sigma)
    if type(value) == 'number' then return value + sigma * t.gauss() end
    if type(value) ~= 'table' then return value end
    local values = {}
    for key, entry in pairs(value) do values[key] = noisy(entry, sigma) end
    return values
end

function t.faults.noise(script, name, sigma, result)
    asScript(script):wrap(name, function(call, ...)
        local results = table.pack(call(...))
        for i = 1, results.n do
            if not result or i == result then results[i] = noisy(results[i], sigma) end
        end
        return table.unpack(results, 1, results.n)
    end)
end

function t.faults.dropout(script, name, probability, ...)
    local instead = table.pack(...)
    asScript(script):wrap(name, function(call, ...)
        if math.random() < probability then return table.unpack(instead, 1, instead.n) end
        return call(...)
    end)
end

function t.faults.delay(script, name, seconds)
    asScript(script):wrap(name, function(call, ...)
        local arguments = table.pack(...)
        t.at(t.time() + seconds, function() call(table.unpack(arguments, 1, arguments.n)) end)
    end)
end

function t.faults.friction(joint, force)
    -- A motor that holds still with the force of the friction; one that drives has that much less.
    local handle = type(joint) == 'string' and sim.getObject(joint) or joint
    if sim.getObjectInt32Param(handle, sim.jointintparam_dynctrlmode) == sim.jointdynctrl_free then
        sim.setObjectInt32Param(handle, sim.jointintparam_dynctrlmode, sim.jointdynctrl_velocity)
        sim.setJointTargetVelocity(handle, 0)
        sim.setJointTargetForce(handle, force)
    else
        sim.setJointTargetForce(handle, math.max(0, sim.getJointTargetForce(handle) - force))
    end
end

---------------------------------------------------------------- recordings

recorder.time, recorder.signal = t.time, t.signal

-- @api table recording = swanilda.test.golden(string name, table quantities, table options = nil)
function t.golden(name, quantities, options)
    local recording = recorder.begin(name, quantities, options)
    recordings[#recordings + 1] = recording
    if sim.getSimulationState() ~= sim.simulation_stopped then recording:sample() end
    return recording
end

local IMAGE_OPTIONS <const> = { name = 'string', tolerance = 'number', share = 'number' }

-- @api swanilda.test.image(any sensor, table options = nil)
function t.image(sensor, options)
    options = options or {}
    for option, value in pairs(options) do
        if type(value) ~= IMAGE_OPTIONS[option] then error('t.image: wrong option ' .. tostring(option) .. '.', 2) end
    end
    local handle = type(sensor) == 'string' and sim.getObject(sensor) or sensor
    native.image(options.name or 'image', handle, options.tolerance or 2, options.share or 0)
end

-- Called by the runner when the test is over.
function t._finish()
    for _, recording in ipairs(recordings) do
        native.golden(recording.name, recording.columns, recording.rows, recording.options)
    end
end

return t
