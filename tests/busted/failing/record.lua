-- Writes the messages of the installed luassert into the files named: lua record.lua *.txt
local folder = arg[0]:match('^(.*/)') or './'
local cases = dofile(folder .. 'cases.lua')
local names = {}
for _, name in ipairs{'spy', 'stub', 'mock', 'match'} do names[name] = require('luassert.' .. name) end
names.assert, names.say = require 'luassert', require 'say'

for _, path in ipairs(arg) do
    local file = assert(io.open(path))
    local list = cases.parse(file:read('a'))
    file:close()
    for _, case in ipairs(list) do case.message = cases.run(case.code, names) end
    file = assert(io.open(path, 'w'))
    file:write(cases.format(list))
    file:close()
end
