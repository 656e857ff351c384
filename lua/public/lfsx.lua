--[[
Of the functions on paths only isfile, isdir and realpath access the file system.
]]

local _, native = ...
local lfs = require 'lfs'

local SEPARATOR <const> = package.config:sub(1, 1)

--- The separator of paths.
-- @api string separator = lfsx.pathsep()
function lfs.pathsep() return SEPARATOR end

--- Separators of this system, none twice, none at the end.
-- @api string path = lfsx.pathsanitize(string p)
function lfs.pathsanitize(p)
    if SEPARATOR == '\\' then p = p:gsub('/', '\\') end
    local pattern = SEPARATOR == '\\' and '\\\\+' or '/+'
    p = p:gsub(pattern, (SEPARATOR:gsub('%%', '%%%%')))
    if #p > 1 and p:sub(-1) == SEPARATOR then p = p:sub(1, -2) end
    return p
end

--- The folder and the last name of a path.
-- @api string folder, string name = lfsx.pathsplit(string p)
function lfs.pathsplit(p)
    p = lfs.pathsanitize(p)
    local folder, name = p:match('^(.*)' .. (SEPARATOR == '\\' and '\\' or '/') .. '(.*)$')
    if not folder then return '', p end
    return folder == '' and SEPARATOR or folder, name
end

--- Parts joined by separators; an absolute part restarts the path.
-- @api string path = lfsx.pathjoin(...)
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

--- The names in a path; the first one is '/' if the path is absolute.
-- @api string[] parts = lfsx.pathparts(string p)
function lfs.pathparts(p)
    p = lfs.pathsanitize(p)
    local parts = {}
    if SEPARATOR == '/' and p:sub(1, 1) == '/' then parts[1] = '/' end
    for name in p:gmatch('[^' .. (SEPARATOR == '\\' and '\\' or '/') .. ']+') do parts[#parts + 1] = name end
    return parts
end

--- The last name of a path.
-- @api string name = lfsx.basename(string path)
function lfs.basename(path) return (select(2, lfs.pathsplit(path))) end

--- The folder of a path.
-- @api string folder = lfsx.dirname(string path)
function lfs.dirname(path) return (lfs.pathsplit(path)) end

--- Whether a path is a regular file.
-- @api bool result = lfsx.isfile(string p)
function lfs.isfile(p) return lfs.attributes(p, 'mode') == 'file' end

--- Whether a path is a folder.
-- @api bool result = lfsx.isdir(string p)
function lfs.isdir(p) return lfs.attributes(p, 'mode') == 'directory' end

--- Whether a path is absolute.
-- @api bool result = lfsx.ispathabsolute(string path)
function lfs.ispathabsolute(path)
    if SEPARATOR == '\\' then return path:find('^%a:[\\/]') ~= nil or path:find('^[\\/][\\/]') ~= nil end
    return path:sub(1, 1) == '/'
end

lfs.gettempdir = native.gettempdir
lfs.realpath = native.realpath

--- Makes a folder and those above it. An existing one is an error unless exist_ok.
-- @api bool result = lfsx.makedirs(string path, bool exist_ok = false)
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
-- @api bool result = lfsx.rmdir_r(string dir)
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
