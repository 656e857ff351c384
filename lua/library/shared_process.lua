--[[
For scripts whose simulator shares its process with others, as in `swanilda test`: they cannot exit it, and their output to
standard output and error goes to the console of their simulator. Internal.
]]

local toConsole = ...

function os.exit() error('os.exit: the process is not this script\'s to end.', 2) end

local methods = getmetatable(io.stdout).__index
local writeTo, write = methods.write, io.write
local streams = { [io.stdout] = 'stdout', [io.stderr] = 'stderr' }

-- The arguments of a `write` as one text, with numbers as Lua writes them to files.
local function textOf(...)
    local texts = {}
    for i = 1, select('#', ...) do
        local value = select(i, ...)
        if math.type(value) == 'float' then
            value = ('%.14g'):format(value)
        elseif type(value) ~= 'string' and type(value) ~= 'number' then
            error(("bad argument #%d to 'write' (string expected, got %s)"):format(i, type(value)), 3)
        end
        texts[i] = value
    end
    return table.concat(texts)
end

function methods.write(file, ...)
    if not streams[file] then return writeTo(file, ...) end
    toConsole(streams[file], textOf(...))
    return file
end

function io.write(...)
    local file = io.output()
    if not streams[file] then return write(...) end
    toConsole(streams[file], textOf(...))
    return file
end
