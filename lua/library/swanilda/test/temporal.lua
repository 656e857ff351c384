--[[
Temporal properties: what has to hold over time, sampled at each step. Internal.

A condition is a function that returns a boolean, or a number that says how far from false it is: negative where it does not hold. The
robustness of a property is such a number for the whole run, as signal temporal logic defines it (A. Donze, O. Maler: Robust satisfaction of
temporal logic over real-valued signals, 2010). That of a boolean is infinite.
]]

local M = {}

local monitors = {} -- of the test
local now, leave -- given by the fixture

local function valueOf(condition, what)
    local value = condition()
    if value == true then return math.huge end
    if value == false or value == nil then return -math.huge end
    if type(value) == 'number' and value == value then return value end
    error({ message = ('%s: a condition returns a boolean or a number, not %s.'):format(what, tostring(value)), failed = true }, 0)
end

local function violated(monitor, reason)
    monitor.isOver = true
    if monitor.robustness >= 0 then monitor.robustness = -math.huge end
    error({ message = ('%s %s'):format(monitor.name, reason), failed = true }, 0)
end

local function measured(value)
    if math.abs(value) == math.huge then return '' end
    return (' (by %.6g)'):format(-value)
end

---------------------------------------------------------------- the four kinds

local always, eventually, holdsUntil, leadsTo = {}, {}, {}, {}

function always.sample(self, time)
    local value = valueOf(self.f, self.name)
    self.robustness = math.min(self.robustness, value)
    return value, value < 0 and ('does not hold at %.6g s%s.'):format(time, measured(value))
end

function always.finish() end

function eventually.sample(self, time)
    local value = valueOf(self.f, self.name)
    self.robustness = math.max(self.robustness, value)
    self.isOver = self:isPast(time)
    if not self.isOver or self.robustness >= 0 then return value end
    return value, ('has not come about within %g s%s.'):format(self.within, measured(self.robustness))
end

function eventually.finish(self, time)
    if self.robustness >= 0 then return end
    if self.within then
        violated(self, ('has not come about when the test ends at %.6g s, before %g s have passed.'):format(time, self.within))
    end
    violated(self, ('has not come about until the end at %.6g s%s.'):format(time, measured(self.robustness)))
end

function holdsUntil.sample(self, time)
    local g = valueOf(self.g, self.name)
    self.robustness = math.max(self.robustness, math.min(g, self.least))
    if g >= 0 then
        self.isOver = true
        return g
    end
    local f = valueOf(self.f, self.name)
    self.least = math.min(self.least, f)
    if f < 0 then return f, ('does not hold at %.6g s%s.'):format(time, measured(f)) end
    return f, self:isPast(time) and ('was not ended within %g s.'):format(self.within)
end

function holdsUntil.finish(self, time) violated(self, ('was not ended until the end at %.6g s.'):format(time)) end

function leadsTo.sample(self, time)
    local f, g = valueOf(self.f, self.name), valueOf(self.g, self.name)
    self.history[#self.history + 1] = { time = time, f = f, g = g }
    if g >= 0 then
        self.since = nil
    elseif f >= 0 then
        self.since = self.since or time
    end
    local value = math.max(-f, g)
    if not self.since or time <= self.since + self.within + 1e-9 then return value end
    self:measure()
    return value, ('was begun at %.6g s and has led to nothing within %g s.'):format(self.since, self.within)
end

-- The least, over all times, of max(-f, the greatest g within the window that begins there).
function leadsTo.measure(self)
    local history, window, last = self.history, {}, #self.history
    local first, count = 1, 0 -- window[first .. count]: samples of falling g, the latest first
    self.robustness = math.huge
    for i = last, 1, -1 do
        local sample = history[i]
        while count >= first and window[count].g <= sample.g do count = count - 1 end
        count = count + 1
        window[count] = sample
        while window[first].time > sample.time + self.within + 1e-9 do first = first + 1 end
        -- A window that the run has cut off says nothing yet.
        local isWhole = history[last].time >= sample.time + self.within - 1e-9
        local value = math.max(-sample.f, window[first].g)
        if isWhole or value >= 0 then self.robustness = math.min(self.robustness, value) end
    end
end

function leadsTo.finish(self) self:measure() end

---------------------------------------------------------------- monitors

local function isPast(self, time) return self.within and time >= self.begun + self.within - 1e-9 end

local function place()
    for level = 4, 8 do
        local info = debug.getinfo(level, 'Sl')
        if not info then return '' end
        if info.source:sub(1, 1) == '@' and info.currentline > 0 then return (' (line %d)'):format(info.currentline) end
    end
    return ''
end

local function checked(value, kind, what)
    if type(value) ~= kind then error(what, 3) end
    return value
end

local function add(kind, word, monitor, name)
    monitor.name = name and ("%s '%s'"):format(word, name) or word .. place()
    monitor.begun, monitor.trace, monitor.isPast = now(), {}, isPast
    monitor.sample, monitor.finish, monitor.measure = kind.sample, kind.finish, kind.measure
    monitors[#monitors + 1] = monitor
    return monitor
end

function M.always(f, name)
    checked(f, 'function', 't.always: a function is expected.')
    return add(always, 'always', { f = f, robustness = math.huge }, name)
end

function M.eventually(f, within, name)
    checked(f, 'function', 't.eventually: a function is expected.')
    if within ~= nil then checked(within, 'number', 't.eventually: within is a number of seconds.') end
    return add(eventually, 'eventually', { f = f, within = within, robustness = -math.huge }, name)
end

function M.holdsUntil(f, g, within, name)
    checked(f, 'function', 't.holdsUntil: two functions are expected.')
    checked(g, 'function', 't.holdsUntil: two functions are expected.')
    if within ~= nil then checked(within, 'number', 't.holdsUntil: within is a number of seconds.') end
    local monitor = { f = f, g = g, within = within, robustness = -math.huge, least = math.huge }
    return add(holdsUntil, 'until', monitor, name)
end

function M.leadsTo(f, g, within, name)
    checked(f, 'function', 't.leadsTo: two functions are expected.')
    checked(g, 'function', 't.leadsTo: two functions are expected.')
    checked(within, 'number', 't.leadsTo: within is a number of seconds.')
    return add(leadsTo, 'leadsTo', { f = f, g = g, within = within, robustness = math.huge, history = {} }, name)
end

-- Samples one, or all; an error when one is violated.
local function sampleOne(monitor)
    if monitor.isOver then return end
    local time = now()
    local trace = monitor.trace
    if #trace > 0 and trace[#trace][1] == time then return end
    local value, reason = monitor:sample(time)
    trace[#trace + 1] = { time, value }
    if reason then violated(monitor, reason) end
end

function M.sample()
    for _, monitor in ipairs(monitors) do sampleOne(monitor) end
end

--- The least robustness of all; infinite without any. Those that a failure has cut short count as far as they came.
function M.robustness()
    local least = math.huge
    for _, monitor in ipairs(monitors) do least = math.min(least, monitor.robustness) end
    return least
end

--- The test is over: an error when one of them does not hold.
function M.finish()
    local time = now()
    for _, monitor in ipairs(monitors) do
        if not monitor.isOver then
            sampleOne(monitor)
            if not monitor.isOver then monitor:finish(time) end
        end
    end
end

--- Ends the watch of all.
function M.forget() monitors = {} end

--- Leaves what was sampled for the report.
function M.leave()
    for _, monitor in ipairs(monitors) do leave(monitor.name, monitor.trace, monitor.robustness) end
end

--- The fixture gives the clock, and the function that takes what was sampled.
function M.begin(clock, signal) now, leave = clock, signal end

return M
