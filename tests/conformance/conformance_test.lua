--[[
The conformance suite as tests of `swanilda test`: each case is a test that runs a script in a simulator of its own and compares what it
printed with what CoppeliaSim 4.10 printed. Cases that KNOWN.md lists are pending. The headers of a case are told in the READMEs of the folders.

    swanilda test tests/conformance --filter joint
]]

local lfs = require 'lfs'
local t = require 'swanilda.test'
local compare = require 'compare'

local function read(path)
    local file = assert(io.open(path, 'rb'))
    local text = file:read('a')
    file:close()
    return text
end

local function known()
    local reasons = {}
    for name, reason in read(t.file('KNOWN.md')):gmatch('\n| `([^`]+)` | ([^\n]-) |') do reasons[name] = reason end
    return reasons
end

-- The cases of a folder and those below, sorted: each .lua with an .expected beside it.
local function cases(folder, found)
    local names = {}
    for name in lfs.dir(t.file(folder)) do names[#names + 1] = name end
    table.sort(names)
    for _, name in ipairs(names) do
        local path = folder == '.' and name or folder .. '/' .. name
        local case = path:match('^(.+)%.lua$')
        if case and lfs.attributes(t.file(case .. '.expected')) then
            found[#found + 1] = case
        elseif not name:find('^%.') and lfs.attributes(t.file(path), 'mode') == 'directory' then
            cases(path, found)
        end
    end
    return found
end

-- What the header of a case asks for, as options of t.run.
local function optionsOf(header)
    local options = { as = header.as or 'sandbox', empty = true }
    local passes = tonumber(header.passes or 0)
    if passes > 0 then
        options.steps = passes
    else
        options.start, options.loops = false, tonumber(header.loops or 20)
    end
    return options
end

local function check(case)
    local header = {}
    for key, value in ('\n' .. read(t.file(case .. '.lua'))):gmatch('\n%-%- (%w+): ([^\n]*)') do
        header[key] = header[key] or value:match('^%s*(.-)%s*$')
    end
    local ran = t.run(case .. '.lua', optionsOf(header))
    local folder = t.file(case):match('^(.*/)') or ''
    local isScene = case:find('^scene/') ~= nil
    local name = case:match('[^/]*$')
    local output = compare.normalized(ran.output, folder, name, isScene)
    local expected = compare.normalized(read(t.file(case .. '.expected')), folder, name, isScene)
    local difference = compare.difference(expected, output, tonumber(header.tol or 0))
    if difference then error({ message = difference, failed = true }) end
end

local reasons = known()
for _, case in ipairs(cases('.', {})) do
    if reasons[case] then
        pending(case, reasons[case])
    else
        it(case, function() check(case) end)
    end
end
