-- What the scripts of sockets_*.py check with.
local lfs = require 'lfs'

local checks = {}

function checks.is(found, expected, what)
    if found ~= expected then error(('%s: %s instead of %s'):format(what, tostring(found), tostring(expected)), 2) end
end

-- How many files and sockets are open.
function checks.descriptors()
    collectgarbage()
    collectgarbage()
    local count = 0
    for _ in lfs.dir('/proc/self/fd') do count = count + 1 end
    return count
end

return checks
