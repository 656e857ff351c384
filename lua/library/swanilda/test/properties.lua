--[[
Properties: tests that run for many cases, whose values a search chooses. Internal: the generators are described in docs/TESTING.md.

Every value comes from choices of the runner (`native.chooseInteger`, `native.chooseFloat`), so that a case can be repeated and shrunk
without code of its generators. Generators nest; what the outermost one returns is noted with its line.
]]

local sim = require('sim')

local M = {}
local native -- the functions of the runner
local depth = 0 -- of generators within each other

local DISCARDED = setmetatable({}, { __tostring = function() return 'the case is discarded' end })
local MAX_LENGTH <const> = 100 -- of a list, unless its maximum says otherwise
local OPTIONS <const> = { cases = 'number', shrinks = 'number', fresh = 'boolean' }

---------------------------------------------------------------- values for people

local function shown(value)
    if math.type(value) == 'float' then return (('%.6g'):format(value)) end
    if type(value) == 'string' then return ('%q'):format(value) end
    local metatable = getmetatable(value)
    if type(value) ~= 'table' or metatable and metatable.__tostring then return tostring(value) end
    local parts = {}
    for i, element in ipairs(value) do parts[i] = shown(element) end
    local keys = {}
    for key in pairs(value) do
        if math.type(key) ~= 'integer' then keys[#keys + 1] = tostring(key) end
    end
    table.sort(keys)
    for _, key in ipairs(keys) do parts[#parts + 1] = key .. ' = ' .. shown(value[key]) end
    return '{' .. table.concat(parts, ', ') .. '}'
end

local function lineOfTest()
    for level = 3, 20 do
        local info = debug.getinfo(level, 'Sl')
        if not info then return 0 end
        if info.source == '@' .. native.file() then return info.currentline end
    end
    return 0
end

-- A case runs in a thread of its own. Before it draws something after time has passed, it waits there: other cases may go on from that moment.
local thread, drawnAt -- of the case that runs

local function await()
    local time = sim.getSimulationTime()
    if time == drawnAt or coroutine.running() ~= thread then return end
    drawnAt = time
    coroutine.yield(true)
end

-- Choices that belong together.
local function part(make, ...)
    local span = native.beginSpan()
    local value = make(...)
    native.endSpan()
    return value, span
end

-- A generator: its choices are a span, and its value is noted unless it is part of another one.
local function generator(make)
    return function(...)
        local line = depth == 0 and lineOfTest()
        if depth == 0 then await() end
        depth = depth + 1
        local value = part(make, ...)
        depth = depth - 1
        if depth == 0 then native.note(line, shown(value)) end
        return value
    end
end

---------------------------------------------------------------- numbers

local g = {}

local function bounds(what, lo, hi)
    if type(lo) ~= 'number' or type(hi) ~= 'number' then error(what .. ': two bounds are expected.', 4) end
    if lo ~= lo or hi ~= hi or lo == -math.huge or hi == math.huge then error(what .. ': bounds are finite.', 4) end
    if lo > hi then error(('%s: the lower bound %s is above the upper one, %s.'):format(what, lo, hi), 4) end
end

local function simplestOf(what, lo, hi, simplest)
    if simplest == nil then return math.max(lo, math.min(hi, 0)) end
    if type(simplest) ~= 'number' or simplest < lo or simplest > hi then
        error(what .. ': the simplest value is within the bounds.', 4)
    end
    return simplest
end

local function float(lo, hi, simplest)
    bounds('g.float', lo, hi)
    return native.chooseFloat(lo, hi, simplestOf('g.float', lo, hi, simplest))
end

local function integer(lo, hi, simplest)
    bounds('g.integer', lo, hi)
    lo, hi = math.tointeger(lo), math.tointeger(hi)
    if not lo or not hi then error('g.integer: the bounds are whole numbers.', 3) end
    simplest = math.tointeger(simplestOf('g.integer', lo, hi, simplest))
    if not simplest then error('g.integer: the simplest value is a whole number.', 3) end
    return native.chooseInteger(lo, hi, simplest)
end

local function boolean() return native.chooseInteger(0, 1, 0) == 1 end

-- A number is itself; {lo, hi} is a number between.
local function within(range, default)
    if range == nil then range = default or 0 end
    if type(range) == 'number' then return range end
    return float(range[1], range[2])
end

-- How many, of {least, most} or a number.
local function count(range, default)
    if range == nil then range = default end
    if type(range) == 'number' then return range, range end
    return range[1], range[2]
end

g.float, g.integer, g.boolean = generator(float), generator(integer), generator(boolean)

g.seed = generator(function()
    local seed = native.chooseInteger(0, 0x7fffffff, 0)
    math.randomseed(seed)
    return seed
end)

---------------------------------------------------------------- choices and collections

g.choice = generator(function(list)
    if type(list) ~= 'table' or #list == 0 then error('g.choice: a list of alternatives is expected, the simplest first.', 3) end
    return list[native.chooseInteger(1, #list, 1)]
end)

g.subset = generator(function(list)
    if type(list) ~= 'table' then error('g.subset: a list is expected.', 3) end
    local chosen = {}
    for _, element in ipairs(list) do
        if boolean() then chosen[#chosen + 1] = element end
    end
    return chosen
end)

-- Whether another element follows. It is a choice also where there is none, so that elements can be left out and what comes after stays.
local function follows(count, least, most)
    if count < least then return native.chooseInteger(1, 1, 1) == 1 end
    if count >= most then return native.chooseInteger(0, 0, 0) == 1 end
    return native.follows(1 - 1 / (2 + (most - least) / 2))
end

local function list(element, least, most)
    local elements, spans = {}, {}
    local function isMore()
        if not follows(#elements, least, most) then return false end
        elements[#elements + 1] = element(#elements + 1)
        return true
    end
    repeat
        local more
        more, spans[#spans + 1] = part(isMore)
    until not more
    return elements, spans
end

g.list = generator(function(element, options)
    if type(element) ~= 'function' then error('g.list: a function that draws an element is expected.', 3) end
    options = options or {}
    return list(element, options.min or 0, options.max or MAX_LENGTH)
end)

---------------------------------------------------------------- geometry

local function point(space) return { within(space.x), within(space.y), within(space.z) } end

-- Angles about the fixed axes x, y, z, in this order: a pose as sim.getObjectPose returns it.
local function pose(space)
    local a, b, c = within(space.roll) / 2, within(space.pitch) / 2, within(space.yaw) / 2
    local sa, ca, sb, cb, sc, cc = math.sin(a), math.cos(a), math.sin(b), math.cos(b), math.sin(c), math.cos(c)
    local p = point(space)
    return {
        p[1], p[2], p[3],
        sa * cb * cc - ca * sb * sc, ca * sb * cc + sa * cb * sc, ca * cb * sc - sa * sb * cc, ca * cb * cc + sa * sb * sc,
    }
end

g.point = generator(function(space) return point(space or {}) end)
g.pose = generator(function(space) return pose(space or {}) end)

g.path = generator(function(space, options)
    local least, most = count(options and options.points, { 2, 6 })
    return list(function() return point(space) end, least, most)
end)

local function isClear(place, radius, discs)
    for _, disc in ipairs(discs) do
        local dx, dy = place[1] - disc[1], place[2] - disc[2]
        if dx * dx + dy * dy < (radius + disc[3]) ^ 2 then return false end
    end
    return true
end

local function obstacle(space)
    local kind = native.chooseInteger(1, 2, 1)
    local place, size, height = point(space), within(space.size, { 0.1, 0.5 }), within(space.height, 0.5)
    return { kind = kind == 1 and 'cylinder' or 'cuboid', x = place[1], y = place[2], size = size, height = height }
end

local function build(made)
    local kind = made.kind == 'cylinder' and sim.primitiveshape_cylinder or sim.primitiveshape_cuboid
    local shape = sim.createPrimitiveShape(kind, { made.size, made.size, made.height }, 0)
    sim.setObjectAlias(shape, 'obstacle')
    sim.setObjectPosition(shape, { made.x, made.y, made.height / 2 })
    sim.setObjectInt32Param(shape, sim.shapeintparam_respondable, 1)
    sim.setObjectSpecialProperty(shape,
        sim.objectspecialproperty_collidable | sim.objectspecialproperty_measurable | sim.objectspecialproperty_detectable)
    return shape
end

-- Those that stand in the way of the discs `clear` are left out. Returns their handles, and what they are.
local made -- what the last call has made
local drawObstacles = generator(function(space)
    local least, most = count(space.count, { 0, 5 })
    made = list(function() return obstacle(space) end, least, most)
    local kept = {}
    for _, one in ipairs(made) do
        if isClear({ one.x, one.y }, one.size * 0.71, space.clear or {}) then kept[#kept + 1] = one end
    end
    made = kept
    return kept
end)

function g.obstacles(space)
    local handles = {}
    for i, one in ipairs(drawObstacles(space or {})) do handles[i] = build(one) end
    return handles, made
end

---------------------------------------------------------------- conditions

function g.assume(condition)
    if not condition then error(DISCARDED, 0) end
end

function g.note(name, value) native.note(lineOfTest(), ('%s = %s'):format(name, shown(value))) end

---------------------------------------------------------------- running

function M.check(options)
    for name, value in pairs(options) do
        if type(value) ~= OPTIONS[name] then error(('t.property: wrong option %s.'):format(tostring(name)), 3) end
    end
end

-- Two cases that fail at the same place with messages that differ in numbers only fail for the same reason.
local function placeOf(failure)
    local message = tostring(failure.message or ''):match('^[^\n]*'):gsub('%-?%d[%d.e+-]*', '#')
    return ('%s:%s:%s'):format(failure.script or '', failure.line or '', message)
end

local function tried(body, fixture, explain)
    depth = 0
    local ok, failure = xpcall(body, function(problem)
        if problem == DISCARDED then return problem end
        return explain(problem)
    end, g)
    if ok then ok, failure = xpcall(fixture.finishCase, explain) end
    if not ok and type(failure) ~= 'table' then failure = { message = tostring(failure) } end
    return ok, failure
end

-- Runs a case of a search, and reports how it has ended.
local function reported(body, fixture, explain)
    local ok, failure = tried(body, fixture, explain)
    local robustness = fixture.robustness()
    if ok then
        native.endCase('passed', '', robustness)
    elseif failure == DISCARDED then
        native.endCase('discarded', '', math.huge)
    else
        native.endCase('failed', placeOf(failure), robustness < 0 and robustness or -math.huge)
    end
end

-- Runs a case on in its thread, to its end; and all others that share its run up to a moment at which it draws something.
local function onward(resume)
    while resume() do
        local wasCalled, failure = native.eachBranch(function() onward(resume) end)
        if failure then error(failure, 0) end
        if wasCalled then return end
    end
end

local function begun(body, fixture, explain)
    drawnAt = sim.getSimulationTime()
    local resume = coroutine.wrap(function()
        thread = coroutine.running()
        reported(body, fixture, explain)
    end)
    onward(resume)
end

--- Runs a property for all cases there are; raises the failure of a single one.
function M.run(body, fixture, explain)
    if native.areCasesUndone() then
        local ok, failure = pcall(native.eachCase, function() begun(body, fixture, explain) end)
        if not ok then
            error(tostring(failure) .. ' Or each case has a simulator of its own: t.property(name, {fresh = true}, ...).', 0)
        end
        if failure then error(failure, 0) end
        return
    end
    local isSingle = native.beginCase()
    if isSingle == false then
        begun(body, fixture, explain)
        -- What is left of it is not the test's.
        fixture.forget()
    elseif isSingle then
        local ok, failure = tried(body, fixture, explain)
        native.endCase('passed', '', math.huge)
        if not ok and failure ~= DISCARDED then error(failure, 0) end
    end
end

M.shown = shown

--- What makes a generator that draws a part of its elements later.
local later = { line = lineOfTest }

local function inner(make, ...)
    await()
    depth = depth + 1
    local first, second = make(...)
    depth = depth - 1
    return first, second
end

--- At most so many elements, each with what is drawn of it now and a span for the rest.
function later.list(most, element)
    local values, spans = inner(list, element, 0, most)
    local elements = {}
    for i, value in ipairs(values) do elements[i] = { value = value, span = spans[i] } end
    return elements
end

--- Draws another part of that span.
function later.drawn(span, make, ...)
    await()
    native.resumeSpan(span)
    local value = inner(make, ...)
    native.endSpan()
    return value
end

function later.note(line, value) native.note(line, shown(value)) end

--- The fixture gives the functions of the runner, and what makes g.faults.
function M.begin(functions, faults)
    native = functions
    g.faults = faults(g, later)
end

return M
