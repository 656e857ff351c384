--[[
Failures are results: nil, the reason, and its number. Only dir raises an error.
]]

local _, native = ...

local lfs = {
    _VERSION = 'LuaFileSystem 1.8.0', currentdir = native.currentdir, chdir = native.chdir, mkdir = native.mkdir,
    rmdir = native.rmdir, link = native.link, lock = native.lock,
}

local FIELDS = {
    mode = true, dev = true, ino = true, nlink = true, uid = true, gid = true, rdev = true, access = true, modification = true,
    change = true, size = true, permissions = true, blocks = true, blksize = true, target = true,
}

local function attributes(path, what, follow)
    if type(what) == 'string' and not FIELDS[what] then error(("invalid attribute name '%s'"):format(what), 3) end
    local known, message, code = native.attributes(path, follow)
    if not known then return nil, message, code end
    if type(what) == 'string' then return known[what] end
    if type(what) ~= 'table' then return known end
    for name, value in pairs(known) do what[name] = value end
    return what
end

--- Attributes of a file as a table; one of them if `what` is its name. If `what` is a table, they are written into it.
-- @api any result, string message, int code = lfs.attributes(string path, any what = nil)
function lfs.attributes(path, what) return attributes(path, what, true) end

--- Attributes of a link itself; `target` is one of them.
-- @api any result, string message, int code = lfs.symlinkattributes(string path, any what = nil)
function lfs.symlinkattributes(path, what) return attributes(path, what, false) end

--- Sets the times of last access and modification, in seconds since 1970.
-- @api bool result, string message, int code = lfs.touch(string path, float access = os.time(), float modification = access)
function lfs.touch(path, access, modification)
    local now = os.time()
    access = access or now
    return native.touch(path, access, modification or access)
end

local Directory = {}
Directory.__index = Directory

function Directory:next()
    if not self.names then error('closed directory', 2) end
    self.position = self.position + 1
    local name = self.names[self.position]
    if name == nil then self.names = nil end
    return name
end

function Directory:close() self.names = nil end
Directory.__close, Directory.__gc = Directory.close, Directory.close

--- An iterator over the sorted names in a folder, and an object with next() and close().
-- @api func next, any directory = lfs.dir(string path)
function lfs.dir(path)
    local names, message = native.list(path)
    if not names then error(message, 2) end
    local directory = setmetatable({names = names, position = 0}, Directory)
    return Directory.next, directory, nil, directory
end

--- Releases the lock of an open file.
-- @api bool result, string message, int code = lfs.unlock(any file)
function lfs.unlock(file) return native.lock(file, 'u') end

--- Without effect except on Windows.
-- @api bool result, string mode = lfs.setmode(any file, string mode)
function lfs.setmode(file, mode)
    if io.type(file) ~= 'file' then error('bad argument #1 to \'setmode\' (open file expected)', 2) end
    if mode ~= 'binary' and mode ~= 'text' then error(("bad argument #2 to 'setmode' (invalid option '%s')"):format(mode), 2) end
    return true, 'binary'
end

return lfs
