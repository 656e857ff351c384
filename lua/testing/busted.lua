--[[
The vocabulary of busted: describe, it and what belongs to them. `swanilda test` loads a test file through it and runs its tests one by one.

    describe(name, block)      context: a group of tests; may be nested
    it(name, test)             spec, test: one test; without a function it is pending
    pending(name)              a test to be written; inside of a test: ends it as pending
    before_each, after_each    run before and after each test of the group, outermost first, innermost first
    setup, teardown            run once, before the first and after the last test of the group (also lazy_ and strict_)
    finally(fn)                inside of a test: runs when it is over
    insulate, expose           groups that keep, or do not keep, changes of globals and loaded modules to themselves
    function test_name()       a global function of such a name is a test as well
    assert, spy, stub, mock, match      see luassert

These names belong to the test file. What it requires has Lua's own assert; what it calls global is global for all.

A file that loads neither `sim` nor `swanilda.test` runs as in busted: in one Lua state, one test after the other. Of any other file each test
gets a simulator of its own, in which the file is loaded anew, so that setup and teardown run for each test.
]]

local _, compiled = ... -- the file as the runner keeps it
local assert, failures = require('luassert'), require('luassert.failure')
local spy, stub, mock, match = require('luassert.spy'), require('luassert.stub'), require('luassert.mock'), require('luassert.match')

local M = {}

failures.raise_objects(true)

local PENDING = {} -- the metatable of the value that ends a pending test

local root -- the group that is the file
local group -- the group being filled
local tests -- all tests by their number
local count -- how many there are
local wanted -- the number of the only one that will run; nil: all may
local path -- the file
local open -- groups whose setup has run, outermost first
local final -- what `finally` was given by the running test

---------------------------------------------------------------- collecting

local function newGroup(name, parent)
    return { name = name, parent = parent, setup = {}, teardown = {}, before_each = {}, after_each = {} }
end

local function currentLine()
    for level = 3, 12 do
        local info = debug.getinfo(level, 'Sl')
        if info and info.source == '@' .. path then return info.currentline end
    end
end

local function names(owner, name)
    local list = { name }
    while owner.parent do
        table.insert(list, 1, owner.name)
        owner = owner.parent
    end
    return list
end

-- Whether the next test may run. All others are counted only: a file has its tests loaded as often as it has tests.
local function isWanted()
    if not wanted or count + 1 == wanted then return true end
    count = count + 1
end

local function addTest(name, body, line, reason, property)
    count = count + 1
    tests[count] = { name = name, body = body, group = group, line = line or -1, pending = reason, property = property }
end

local function describe(name, block)
    local outer = group
    group = newGroup(tostring(name), outer)
    local inner, line = group, currentLine()
    local ok, message = xpcall(block or function() end, M.explain)
    if not ok then
        -- What is wrong with a group is told as a test of its own.
        group = inner
        if isWanted() then addTest('(group)', function() error(message, 0) end, line) end
    end
    group = outer
    return inner
end

local function insulate(name, block)
    if type(name) == 'function' then name, block = 'insulate block', name end
    describe(name, block).insulated = true
end

local function expose(name, block)
    if type(name) == 'function' then name, block = 'expose block', name end
    describe(name, block)
end

local function it(name, body)
    if not isWanted() then return end
    local line = currentLine()
    if body == nil then return addTest(tostring(name), nil, line, 'not written yet') end
    addTest(tostring(name), body, line)
end

--- A test that runs for many cases: `options` says for how many.
function M.property(name, options, body)
    if isWanted() then addTest(tostring(name), body, currentLine(), nil, options) end
end

-- Between tests it announces one; within a test it ends it.
local function pending(name, body)
    if open then error(setmetatable({ reason = tostring(name or 'pending') }, PENDING), 0) end
    if not isWanted() then return end
    addTest(tostring(name), nil, currentLine(), type(body) == 'string' and body or 'pending')
end

local function hook(kind)
    return function(action) table.insert(group[kind], action) end
end

local function finally(action) final[#final + 1] = action end

local VOCABULARY = {
    describe = describe, context = describe, insulate = insulate, expose = expose,
    it = it, spec = it, test = it, pending = pending, finally = finally,
    before_each = hook('before_each'), after_each = hook('after_each'),
    setup = hook('setup'), lazy_setup = hook('setup'), strict_setup = hook('setup'),
    teardown = hook('teardown'), lazy_teardown = hook('teardown'), strict_teardown = hook('teardown'),
    randomize = function() end, -- the order of tests is that of the file
    assert = assert, spy = spy, stub = stub, mock = mock, match = match,
}

-- The global functions test_* in the order of their lines; setup and the like may be functions of the file then.
local function addPlainTests(known, environment)
    local found = {}
    for name, value in pairs(_G) do
        if type(name) == 'string' and name:find('^test_') and type(value) == 'function' and known[name] ~= value then
            found[#found + 1] = { name = name, body = value, line = debug.getinfo(value, 'S').linedefined }
        end
    end
    table.sort(found, function(a, b) return a.line < b.line or a.line == b.line and a.name < b.name end)
    for _, test in ipairs(found) do
        if isWanted() then addTest(test.name, test.body, test.line) end
    end
    if #found == 0 then return end
    for plain, kind in pairs { setup = 'before_each', teardown = 'after_each', before_each = 'before_each', after_each = 'after_each' } do
        local own = rawget(environment, plain)
        if type(own) == 'function' and own ~= VOCABULARY[plain] then table.insert(root[kind], own) end
    end
end

local function copy(from)
    local to = {}
    for key, value in pairs(from) do to[key] = value end
    return to
end

-- Loads the file, for the test with that number or for all. Returns what went wrong, or nil, the chunk and its environment.
local function loadFile(file, number)
    path, tests, count, wanted, open, root = file, {}, 0, number, nil, newGroup('')
    group = root
    -- The sandbox has loaded it; whether the file wants it is what counts.
    _G.sim, package.loaded.sim, package.loaded['sim-1'] = nil, nil, nil
    -- The vocabulary is that of the test file; what it tests has Lua's own assert.
    local environment = setmetatable(copy(VOCABULARY), { __index = _G, __newindex = _G })
    local known = copy(_G)
    local chunk, message = compiled.load(environment, number)
    if not chunk then chunk, message = loadfile(file, 'bt', environment) end
    if not chunk then return { message = message, line = tonumber(message:match(':(%d+): ')) } end
    local ok, failure = xpcall(chunk, M.explain)
    if not ok then return failure end
    addPlainTests(known, environment)
    return nil, chunk, environment
end

-- The first and the last line of each test's function, in one list; nil if the file has its own idea of what a test is.
local function linesOfTests(environment)
    for _, name in ipairs { 'it', 'spec', 'test' } do
        if rawget(environment, name) ~= it then return end
    end
    local lines = {}
    for i, test in ipairs(tests) do
        local info = type(test.body) == 'function' and debug.getinfo(test.body, 'S') or { linedefined = 0, lastlinedefined = 0 }
        lines[2 * i - 1], lines[2 * i] = info.linedefined, info.lastlinedefined
    end
    return lines
end

--- Loads a test file. Its tests, in order: name (the groups' names first), line, pending.
-- Returns also whether the file uses the simulator.
function M.collect(file)
    local failure, chunk, environment = loadFile(file)
    if failure then return { error = failure } end
    local list = {}
    for i, test in ipairs(tests) do
        list[i] = { name = names(test.group, test.name), line = test.line, pending = test.pending, property = test.property }
    end
    compiled.keep(chunk, linesOfTests(environment))
    return { tests = list, simulates = (package.loaded.sim or package.loaded['swanilda.test']) ~= nil }
end

--- Loads a test file of which the tests are known, to run all of them or the one with that number. Returns what went wrong.
function M.load(file, number)
    return { error = loadFile(file, number) }
end

---------------------------------------------------------------- running

-- The line of the file where an error came from, as far as the running functions tell.
local function errorLine()
    for level = 3, 60 do
        local info = debug.getinfo(level, 'Sl')
        if not info then return end
        if info.source == '@' .. path and info.currentline > 0 then return info.currentline end
    end
end

-- Tables without a text of their own are shown with their elements.
local function shown(problem)
    local metatable = debug.getmetatable(problem)
    local isBare = type(problem) == 'table' and not (metatable and metatable.__tostring)
    return isBare and assert:format({ problem, n = 1 })[1] or tostring(problem)
end

--- A message handler: what went wrong, as a table of texts.
function M.explain(problem)
    if getmetatable(problem) == PENDING then return { pending = problem.reason } end
    if type(problem) == 'table' and problem.explained then return problem end
    local text = problem
    if type(problem) == 'table' and type(problem.message) == 'string' then text = problem.message end
    return {
        explained = true,
        message = shown(text),
        failed = failures.is(problem) or type(problem) == 'table' and problem.failed,
        line = errorLine(),
        trace = debug.traceback('', 2),
        script = type(problem) == 'table' and problem.script or nil,
    }
end

local function attempt(actions, problem)
    for _, action in ipairs(actions) do
        local ok, failure = xpcall(action, M.explain)
        -- Lua runs no handler when the memory is at its end.
        if not ok and type(failure) ~= 'table' then failure = { message = tostring(failure) .. ' (--memory).' } end
        if not ok then problem = problem or failure end
    end
    return problem
end

local function chainOf(owner)
    local chain = {}
    while owner do
        table.insert(chain, 1, owner)
        owner = owner.parent
    end
    return chain
end

local function closeGroup()
    local closing = table.remove(open)
    local problem = attempt(closing.teardown)
    if closing.kept then
        for _, saved in ipairs(closing.kept) do
            for key in pairs(saved.now) do saved.now[key] = saved.was[key] end
            for key, value in pairs(saved.was) do saved.now[key] = value end
        end
    end
    return problem
end

local function openGroup(opening)
    if opening.insulated or not opening.parent then
        opening.kept = { { now = _G, was = copy(_G) }, { now = package.loaded, was = copy(package.loaded) } }
    end
    open[#open + 1] = opening
    return attempt(opening.setup)
end

-- Leaves the groups a test is not in and enters those it is in.
local function moveTo(chain)
    open = open or {}
    local problem
    while open[#open] and chain[#open] ~= open[#open] do problem = closeGroup() or problem end
    while not problem and #open < #chain do problem = openGroup(chain[#open + 1]) end
    return problem
end

local function afterEach(chain, problem)
    for i = #chain, 1, -1 do problem = attempt(chain[i].after_each, problem) end
    return problem
end

local function beforeEach(chain)
    for _, each in ipairs(chain) do
        local problem = attempt(each.before_each)
        if problem then return problem end
    end
end

local function outcome(problem)
    if not problem then return { status = 'passed' } end
    if problem.pending then return { status = 'pending', message = problem.pending } end
    problem.status = problem.failed and 'failed' or 'error'
    return problem
end

--- Runs a test with all that belongs to it. Returns status (passed, failed, error, pending) and what went wrong.
function M.run(index)
    local test = tests[index]
    if test.pending then return { status = 'pending', message = test.pending, todo = true } end
    local chain = chainOf(test.group)
    final = {}
    local problem = moveTo(chain) or beforeEach(chain)
    local fixture = package.loaded['swanilda.test']
    local body = test.property and function() fixture._runProperty(test.body, M.explain) end or test.body
    if not problem then problem = attempt({ body }) end
    problem = attempt(final, problem)
    problem = afterEach(chain, problem)
    if fixture then problem = attempt({ function() fixture._finish(problem ~= nil) end }, problem) end
    return outcome(problem)
end

--- Leaves all groups. Returns what went wrong in their teardown.
function M.finish()
    return outcome(moveTo({}))
end

-- Modules a suite may require.
package.loaded['busted.runner'] = function() return function() end end
for name, value in pairs(VOCABULARY) do M[name] = M[name] or value end

return M
