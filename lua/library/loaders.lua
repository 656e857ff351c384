--[[
With coverage or a debugger, instruments code that scripts load. Internal.
]]

local count, upvalue, table_ = ...
local type, error, pcall = type, error, pcall
local getupvalue, setupvalue = debug.getupvalue, debug.setupvalue

-- A function that was dumped has lost the table its probes or traps write to.
local function withTable(chunk)
    for i = 1, 255 do
        local name = getupvalue(chunk, i)
        if not name then return end
        if name == upvalue then setupvalue(chunk, i, table_ or {}) end
    end
end

local function counted(chunk, ...)
    if type(chunk) ~= 'function' then return chunk, ... end
    withTable(chunk)
    return count(chunk), ...
end

local loadText, loadFile, dump = load, loadfile, string.dump

-- Never without names, by which the table is known.
function string.dump(chunk) return dump(chunk) end

function load(...) return counted(loadText(...)) end

function loadfile(...) return counted(loadFile(...)) end

function dofile(...)
    local chunk, message = loadfile(...)
    if not chunk then error(message, 0) end
    return chunk()
end

-- The searcher for Lua files, by its place: `package.preload`, Swanilda's library, then Lua files.
local search = package.searchers[3]
package.searchers[3] = function(name)
    -- Through pcall, so that messages do not begin with a line of this file.
    local ok, loader, path = pcall(search, name)
    if not ok then error(loader, 0) end
    return counted(loader, path)
end
