--[[
Files and folders, with the interface of LuaFileSystem.

    attributes(path, what)           table of mode, size, modification, access, change, permissions, dev, ino, nlink, uid, gid, rdev,
                                     blocks, blksize; one of them when `what` names it; filled into `what` when that is a table
    symlinkattributes(path, what)    the same of a link itself; has `target` too
    dir(path)                        iterator over names, and an object with next() and close()
    mkdir, rmdir, chdir(path), currentdir(), link(old, new, symlink), touch(path, access, modification)
    lock(file, mode, start, length), unlock(file, start, length)     of files of io.open; the whole file is locked
    setmode(file, mode)              no effect outside of Windows

Failures are results: nil, the reason, and its number. Only dir raises an error. Names come sorted.
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

function lfs.attributes(path, what) return attributes(path, what, true) end
function lfs.symlinkattributes(path, what) return attributes(path, what, false) end

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

function lfs.dir(path)
    local names, message = native.list(path)
    if not names then error(message, 2) end
    local directory = setmetatable({names = names, position = 0}, Directory)
    return Directory.next, directory, nil, directory
end

function lfs.unlock(file) return native.lock(file, 'u') end

function lfs.setmode(file, mode)
    if io.type(file) ~= 'file' then error('bad argument #1 to \'setmode\' (open file expected)', 2) end
    if mode ~= 'binary' and mode ~= 'text' then error(("bad argument #2 to 'setmode' (invalid option '%s')"):format(mode), 2) end
    return true, 'binary'
end

return lfs
