--[[
Removes functions that start programs or load native libraries from a fresh Lua state; runs after base.lua with --no-unsafe.
]]

local function forbid(library, name)
    library[name] = function() error('programs and native libraries are switched off (--no-unsafe).', 2) end
end

forbid(os, 'execute')
forbid(io, 'popen')
forbid(package, 'loadlib')

-- Those of native libraries stand after that of Lua files, which is the third.
table.remove(package.searchers, 5)
table.remove(package.searchers, 4)
