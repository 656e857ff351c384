--[[
lfs with functions on paths and trees of folders; require 'lfsx' gives lfs with these added.

    pathsep(), pathsanitize(p), pathsplit(p), pathjoin(...), pathparts(p), basename(p), dirname(p)
    isfile(p), isdir(p), ispathabsolute(p), realpath(p), gettempdir()
    makedirs(p, exist_ok), rmdir_r(dir)

pathsplit gives folder and name, pathparts a table of all names, with '/' first where the path is absolute.
]]

local _, native = ...
local lfs = require 'lfs'

local SEPARATOR <const> = package.config:sub(1, 1)

function lfs.pathsep() return SEPARATOR end

--- Separators of this system, none twice, none at the end.
function lfs.pathsanitize(p)
    if SEPARATOR == '\\' then p = p:gsub('/', '\\') end
    local pattern = SEPARATOR == '\\' and '\\\\+' or '/+'
    p = p:gsub(pattern, (SEPARATOR:gsub('%%', '%%%%')))
    if #p > 1 and p:sub(-1) == SEPARATOR then p = p:sub(1, -2) end
    return p
end

function lfs.pathsplit(p)
    p = lfs.pathsanitize(p)
    local folder, name = p:match('^(.*)' .. (SEPARATOR == '\\' and '\\' or '/') .. '(.*)$')
    if not folder then return '', p end
    return folder == '' and SEPARATOR or folder, name
end

--- Parts joined by separators; an absolute part restarts the path.
function lfs.pathjoin(...)
    local joined = ''
    local parts = type((...)) == 'table' and (...) or {...}
    for _, part in ipairs(parts) do
        if joined == '' or lfs.ispathabsolute(part) then
            joined = part
        elseif part ~= '' then
            joined = joined .. SEPARATOR .. part
        end
    end
    return joined == '' and '' or lfs.pathsanitize(joined)
end

function lfs.pathparts(p)
    p = lfs.pathsanitize(p)
    local parts = {}
    if SEPARATOR == '/' and p:sub(1, 1) == '/' then parts[1] = '/' end
    for name in p:gmatch('[^' .. (SEPARATOR == '\\' and '\\' or '/') .. ']+') do parts[#parts + 1] = name end
    return parts
end

function lfs.basename(path) return (select(2, lfs.pathsplit(path))) end
function lfs.dirname(path) return (lfs.pathsplit(path)) end
function lfs.isfile(p) return lfs.attributes(p, 'mode') == 'file' end
function lfs.isdir(p) return lfs.attributes(p, 'mode') == 'directory' end

function lfs.ispathabsolute(path)
    if SEPARATOR == '\\' then return path:find('^%a:[\\/]') ~= nil or path:find('^[\\/][\\/]') ~= nil end
    return path:sub(1, 1) == '/'
end

lfs.gettempdir = native.gettempdir
lfs.realpath = native.realpath

--- Makes a folder and those above it. An existing one is an error unless exist_ok.
function lfs.makedirs(path, exist_ok)
    path = lfs.pathsanitize(path)
    if lfs.isdir(path) then
        if exist_ok then return true end
        error(("makedirs: '%s' exists"):format(path), 2)
    end
    local above = lfs.dirname(path)
    if above ~= '' and above ~= path and not lfs.isdir(above) then lfs.makedirs(above, true) end
    local ok, message = lfs.mkdir(path)
    if not ok then error(("makedirs: '%s': %s"):format(path, message), 2) end
    return true
end

--- Removes a folder with all in it; links are removed, not followed.
function lfs.rmdir_r(dir)
    for name in lfs.dir(dir) do
        if name ~= '.' and name ~= '..' then
            local path = dir .. SEPARATOR .. name
            if lfs.symlinkattributes(path, 'mode') == 'directory' then
                lfs.rmdir_r(path)
            else
                local ok, message = os.remove(path)
                if not ok then error('rmdir_r: ' .. message, 2) end
            end
        end
    end
    local ok, message = lfs.rmdir(dir)
    if not ok then error(("rmdir_r: '%s': %s"):format(dir, message), 2) end
    return true
end

function lfs.unittest()
    assert(lfs.pathjoin('a', 'b') == 'a' .. SEPARATOR .. 'b' and lfs.basename('a/b.c') == 'b.c' and lfs.dirname('a/b.c') == 'a')
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return lfs
