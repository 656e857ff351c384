-- topic: modules
-- as: sandbox
-- passes: 0
-- note: lfs, lfsx
local lfs = require 'lfsx'
print(lfs == require 'lfs')
local root = os.tmpname()
os.remove(root)
local function hide(...)
    local t = table.pack(...)
    for i = 1, t.n do if type(t[i]) == 'string' then t[i] = t[i]:gsub(root, 'ROOT') end end
    return table.unpack(t, 1, t.n)
end
print(lfs.mkdir(root), lfs.mkdir(root))
print(hide(lfs.mkdir(root .. '/a/b')))
print(lfs.makedirs(root .. '/a/b'), hide(pcall(lfs.makedirs, root .. '/a/b')), lfs.makedirs(root .. '/a/b', true))
local file = io.open(root .. '/a/file.txt', 'w')
file:write('hello')
print(lfs.lock(file, 'w'), lfs.unlock(file), lfs.setmode(file, 'binary'), pcall(lfs.lock, file, 'x'))
local other = io.open(root .. '/a/file.txt', 'r')
print(lfs.lock(file, 'w'), (lfs.lock(other, 'r')))
other:close()
file:close()
print(pcall(lfs.lock, file, 'w'))
print(lfs.touch(root .. '/a/file.txt', 1000, 2000))
local known = lfs.attributes(root .. '/a/file.txt')
print(known.mode, known.size, known.access, known.modification, type(known.ino), #known.permissions, known.nlink)
print(lfs.attributes(root, 'mode'), lfs.attributes(root .. '/a/file.txt', {x = 1}).x, pcall(lfs.attributes, root, 'nonsense'))
print(hide(lfs.attributes(root .. '/none')))
print(lfs.link('file.txt', root .. '/a/soft', true), lfs.symlinkattributes(root .. '/a/soft', 'mode'), lfs.symlinkattributes(root .. '/a/soft', 'target'),
    lfs.attributes(root .. '/a/soft', 'mode'), lfs.link(root .. '/a/file.txt', root .. '/a/hard'), lfs.attributes(root .. '/a/hard', 'nlink'))
for name in lfs.dir(root .. '/a') do print(name) end
local iterate, directory = lfs.dir(root)
print(directory:next(), directory:next(), directory:next(), directory:next(), pcall(directory.next, directory))
directory:close()
print(hide(pcall(lfs.dir, root .. '/none')))
print(lfs.isfile(root .. '/a/soft'), lfs.isdir(root), lfs.isdir(root .. '/none'), lfs.realpath(root .. '/a/../a/b') == lfs.realpath(root .. '/a/b'))
local before = lfs.currentdir()
print(lfs.chdir(root), lfs.currentdir() == lfs.realpath(root), lfs.chdir(before), hide((select(2, lfs.chdir(root .. '/none')))))
print((select(2, lfs.rmdir(root))))
print(lfs.rmdir_r(root), lfs.isdir(root))
print(lfs.pathsplit('/a/b.c'), lfs.pathsplit('x'), lfs.pathjoin('a', 'b/', '', 'c'), lfs.pathjoin('a', '/b'), lfs.pathparts('/a//b/'), lfs.pathsanitize('/a//b/'))
print(lfs.basename('/a/b.c'), lfs.dirname('/a/b.c'), lfs.ispathabsolute('/a'), lfs.ispathabsolute('a'), lfs.isdir(lfs.gettempdir()))
