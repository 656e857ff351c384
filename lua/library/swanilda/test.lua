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

Properties and what holds over time, see docs/TESTING.md
    t.property(name, options, fn)       a test that runs for many cases; fn(g) draws its values, such as g.float(0, 1)
    t.always(f[, name])                 f holds at each step from now on: it returns a boolean, or a number that is negative where it does not
    t.eventually(f[, within][, name])   f holds at some step within so many seconds, or until the end
    t.holdsUntil(f, g[, within][, name])    f holds until g does, which it does
    t.leadsTo(f, g, within[, name])     whenever f holds, g does within so many seconds

Faults, from the seed of the run: each returns a fault f, which f:stop() ends. docs/TESTING.md has a table
    t.faults.noise, bias, dropout, stuck, blackout      (script, name, ...) what a function returns
    t.faults.delay, lose, double, reorder               (script, name, ...) calls that send something, such as sim.setFloatSignal
    t.faults.loseRequests, loseReplies, doubleRequests, reorderRequests, delayRequests, vanish     remote clients, with --faults
    t.faults.slow, fail, crash                          (script, ...) programs
    t.faults.backlash, weak, jam, friction              (script or joint, ...) motors
    t.faults.mass, slip, push                           (shape, ...) bodies
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
local temporal = require('swanilda.test.temporal')
local properties = require('swanilda.test.properties')
local busted = require('busted')

local t = {}

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
    temporal.sample()
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

require('swanilda.test.messages')(t, native)

---------------------------------------------------------------- faults

-- @api float number = swanilda.test.random()
function t.random() return math.random() end

-- A number of the standard normal distribution, by the method of Box and Muller.
-- @api float number = swanilda.test.gauss()
function t.gauss()
    return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
end

local makeFaults
t.faults, makeFaults = require('swanilda.test.faults')(t, Script, properties.shown)

---------------------------------------------------------------- temporal properties

temporal.begin(t.time, native.leaveSignal)

local function sampled(monitor)
    if sim.getSimulationState() ~= sim.simulation_stopped then temporal.sample() end
    return monitor
end

-- @api swanilda.test.always(func f, string name = nil)
function t.always(f, name) sampled(temporal.always(f, name)) end

-- @api swanilda.test.eventually(func f, float within = nil, string name = nil)
function t.eventually(f, within, name) sampled(temporal.eventually(f, within, name)) end

-- @api swanilda.test.holdsUntil(func f, func g, float within = nil, string name = nil)
function t.holdsUntil(f, g, within, name) sampled(temporal.holdsUntil(f, g, within, name)) end

-- @api swanilda.test.leadsTo(func f, func g, float within, string name = nil)
function t.leadsTo(f, g, within, name) sampled(temporal.leadsTo(f, g, within, name)) end

---------------------------------------------------------------- properties

properties.begin(native, makeFaults)

-- @api swanilda.test.property(string name, table options, func property)
function t.property(name, options, property)
    if property == nil then options, property = {}, options end
    if type(property) ~= 'function' or type(options) ~= 'table' then
        error('t.property: a name, a table of options and a function are expected.', 2)
    end
    properties.check(options)
    busted.property(name, options, property)
end

local cases = {}

-- What belongs to the end of a case, before what it did is undone.
function cases.finishCase()
    temporal.finish()
    t._checkErrors()
end

cases.robustness, cases.forget = temporal.robustness, temporal.forget

-- Called by the runner to test a property.
function t._runProperty(property, explain) properties.run(property, cases, explain) end

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

-- Called by the runner when the test is over; hasFailed: it has failed already.
function t._finish(hasFailed)
    local ok, failure = pcall(hasFailed and function() end or temporal.finish)
    temporal.leave()
    if not ok then error(failure, 0) end
    for _, recording in ipairs(recordings) do
        native.golden(recording.name, recording.columns, recording.rows, recording.options)
    end
end

return t
