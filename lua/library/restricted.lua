--[[
With restricted permissions, makes `dofile` and `require` load files by `loadfile`, which has the permissions in front, and takes the searchers
of native libraries out where native code is not allowed. Runs after base.lua. Internal.
]]

local nativeAllowed = ...
local error, loadfile, searchpath = error, loadfile, package.searchpath

function dofile(name)
    local chunk, reason = loadfile(name)
    if not chunk then error(reason, 0) end
    return chunk()
end

-- Those of native libraries stand after that of Lua files, which is the third.
if not nativeAllowed then
    table.remove(package.searchers, 5)
    table.remove(package.searchers, 4)
end

-- The searcher for Lua files, by its place: `package.preload`, Swanilda's library, then Lua files.
package.searchers[3] = function(name)
    local path, message = searchpath(name, package.path)
    if not path then return message end
    local loader, reason = loadfile(path)
    if not loader then error(("error loading module '%s' from file '%s':\n\t%s"):format(name, path, reason), 0) end
    return loader, path
end
