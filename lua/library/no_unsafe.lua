--[[
Removes functions that start programs or load native libraries from a fresh Lua state, and makes `require` refuse bytecode; runs after base.lua
with --no-unsafe. `load` and `loadfile` refuse bytecode already.
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

local error, loadfile, searchpath = error, loadfile, package.searchpath

function dofile(name)
    local chunk, reason = loadfile(name)
    if not chunk then error(reason, 0) end
    return chunk()
end

-- The searcher for Lua files, by its place: `package.preload`, Swanilda's library, then Lua files.
package.searchers[3] = function(name)
    local path, message = searchpath(name, package.path)
    if not path then return message end
    local loader, reason = loadfile(path)
    if not loader then error(("error loading module '%s' from file '%s':\n\t%s"):format(name, path, reason), 0) end
    return loader, path
end
