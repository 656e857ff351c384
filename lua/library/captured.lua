--[[
What scripts get from the system by Lua's own libraries, where a run is captured or replayed. A captured run writes what the functions return; a replay
returns that and calls nothing: a file that a script opens is one without a name, with the content of the captured one. Runs after base.lua,
before restricted.lua. Internal.
]]

local native = ...
local replaying = native.replaying -- not any more when a replay goes on live
local enter, leave, put, take, content, lacks = native.enter, native.leave, native.put, native.take, native.content, native.lacks
local load, pcall, error, type, select, unpack, pack = load, pcall, error, type, select, table.unpack, table.pack
local methods = getmetatable(io.stdout).__index
local makeFile, plainOpen, close, readFile = native.tmpfile, io.open, methods.close, methods.read

---------------------------------------------------------------- calls

-- Calls a function of the system; everything that it asks for is part of it. True and its results, or false and its error.
local function called(original, ...)
    enter()
    local results = pack(pcall(original, ...))
    leave()
    return results
end

-- The results of a call, or its error for the script: callers are left by a tail call.
local function finished(results, name)
    -- Each of the functions has a result; pcall (base.lua) returns no nil at the end.
    if results[1] then return unpack(results, 2, results.n > 2 and results.n or 2) end
    local reason = results[2]
    -- Lua does not find the names of functions in front of which others stand.
    if name and type(reason) == 'string' then reason = reason:gsub("^(bad argument #%d+ to )'%?'", "%1'" .. name .. "'") end
    error(reason, 2)
end

local function outside(kind, original)
    return function(...)
        local results = replaying() and pack(take(kind)) or called(original, ...)
        if not replaying() then put(kind, unpack(results, 1, results.n)) end
        return finished(results, kind)
    end
end

for _, name in ipairs {'time', 'clock', 'date', 'getenv', 'remove', 'rename', 'tmpname', 'execute'} do
    os[name] = outside('os.' .. name, os[name])
end

---------------------------------------------------------------- files

-- A file without a name.
local function scratch(text, atEnd)
    local file = makeFile()
    if not file then error('a replay needs room for temporary files', 0) end
    file:write(text)
    if not atEnd then file:seek('set') end
    return file
end

local function isName(value) return type(value) == 'string' or type(value) == 'number' end

local function open(name, mode)
    local kind = 'opening ' .. (isName(name) and name or '?')
    local text = isName(mode) and tostring(mode) or 'r'
    if replaying() then
        local results = pack(take(kind))
        if results[2] ~= 'file' then return results end
        return {true, scratch(results[3] and content(name) or '', text:find '^a'), n = 2}
    end
    local results = called(plainOpen, name, mode)
    if not (results[1] and results[2]) then
        put(kind, unpack(results, 1, results.n))
        return results
    end
    local hasContent = not text:find '^w'
    local isFile = hasContent and native.isRegular(name)
    if hasContent and not isFile then lacks('what is read from ' .. name) end
    put(kind, true, 'file', isFile)
    if isFile then content(name) end
    return results
end

function io.open(name, mode) return finished(open(name, mode), 'io.open') end

---------------------------------------------------------------- programs

-- What closing a file returns that stands for a program: by file.
local outcomes = setmetatable({}, {__mode = 'k'})

local function closed(file)
    local outcome = outcomes[file]
    if not outcome then return finished(pack(pcall(close, file)), 'close') end
    outcomes[file] = nil
    if outcome == true then
        local results = replaying() and pack(take 'the end of a program') or called(close, file)
        if replaying() then close(file) else put('the end of a program', unpack(results, 1, results.n)) end
        return finished(results)
    end
    close(file)
    return unpack(outcome, 1, outcome.n)
end

function methods.close(file) return closed(file) end

local closeDefault = io.close
function io.close(file)
    if file == nil then return closeDefault() end
    return closed(file)
end

-- All that a program prints, and its end.
local function output(file)
    local text = readFile(file, 'a')
    return text, close(file)
end

local plainPopen = io.popen

local function popen(command, mode)
    local kind = 'running ' .. (isName(command) and command or '?')
    local reads = mode == nil or tostring(mode):find '^r'
    local results, file
    if replaying() then
        results = pack(take(kind))
        if not results[1] or results[2] == nil then return results end
        if not reads then file = scratch '' end
    else
        results = called(plainPopen, command, mode)
        if results[1] and results[2] then
            if reads then results = called(output, results[2])
            else file, results = results[2], {true, 'started', n = 2} end
        end
        put(kind, unpack(results, 1, results.n))
        if not results[1] or results[2] == nil then return results end
    end
    if reads then
        file = scratch(results[2])
        outcomes[file] = pack(unpack(results, 3, results.n))
    else
        outcomes[file] = true
    end
    return {true, file, n = 2}
end

function io.popen(command, mode) return finished(popen(command, mode), 'io.popen') end

---------------------------------------------------------------- standard input, files by name

-- Why a file cannot be opened, as functions that raise errors say it.
local function unopened(name, reason)
    local prefix = name .. ': '
    if reason:sub(1, #prefix) ~= prefix then return reason end
    return ("cannot open file '%s' (%s)"):format(name, reason:sub(#prefix + 1))
end

local input = io.stdin
local readInput = outside('standard input', function(...) return readFile(input, ...) end)

function methods.read(file, ...)
    if file == input then return readInput(...) end
    return finished(pack(pcall(readFile, file, ...)), 'read')
end

function io.read(...) return methods.read(io.input(), ...) end

function io.lines(name, ...)
    local formats = pack(...)
    if name == nil then
        return function() return io.read(unpack(formats, 1, formats.n)) end
    end
    local file, reason = unpack(open(name), 2, 3)
    if not file then error(unopened(name, reason), 2) end
    local nextLine = file:lines(...)
    return function()
        local values = pack(nextLine())
        if values[1] == nil then close(file) end
        return unpack(values, 1, values.n)
    end, nil, nil, file
end

for _, direction in ipairs {'input', 'output'} do
    local original, mode = io[direction], direction == 'input' and 'r' or 'w'
    io[direction] = function(file)
        if not isName(file) then return original(file) end
        local opened, reason = unpack(open(file, mode), 2, 3)
        if not opened then error(unopened(file, reason), 2) end
        return original(opened)
    end
end

---------------------------------------------------------------- code

-- Without the mark of UTF-8 and a first line for the shell, as Lua reads files.
local function stripped(text)
    text = text:gsub('^\xEF\xBB\xBF', '')
    return (text:gsub('^#[^\n]*', ''))
end

function loadfile(name, mode, ...)
    if name == nil then return load(readInput 'a', '=stdin', mode, ...) end
    local text, reason = native.code(name)
    if not text then return nil, reason end
    return load(stripped(text), '@' .. name, mode, ...)
end

-- Native libraries are found, and run in captures only.
local searchpath = package.searchpath
for place = 4, 5 do
    local original = package.searchers[place]
    package.searchers[place] = original and function(name)
        local root = place == 4 and name or name:match '^([^.]*)%.'
        if not root then return nil end
        local path, message = searchpath(root, package.cpath)
        if not path then return message end
        lacks('the native library ' .. path)
        if replaying() then error('the native library ' .. path .. ' is not part of the capture', 0) end
        return original(name)
    end
end
