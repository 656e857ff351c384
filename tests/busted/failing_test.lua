-- Assertions that do not hold end with the messages of the original; failing/*.txt has them.
local lfs = require 'lfs'

local folder = debug.getinfo(1, 'S').source:match('^@(.*/)') or './'
local cases = dofile(folder .. 'failing/cases.lua')
local names = {assert = assert, spy = spy, stub = stub, mock = mock, match = match, say = require 'say'}

local function read(path)
    local file = io.open(path)
    local text = file:read('a')
    file:close()
    return text
end

local files = {}
for name in lfs.dir(folder .. 'failing') do
    if name:find('%.txt$') then files[#files + 1] = name end
end
table.sort(files)

it('has files', function() assert.is_true(#files > 0) end)

for _, name in ipairs(files) do
    describe(name, function()
        local list = cases.parse(read(folder .. 'failing/' .. name))
        for i, case in ipairs(list) do
            it(('%d: %s'):format(i, case.code), function()
                assert.are.equal(case.message, cases.run(case.code, names))
            end)
        end
        it('has cases', function() assert.is_true(#list > 0) end)
    end)
end
