--[[
Functions for interactive use: evaluating a typed line, help, completion, dumps of bytes.

Does not read a terminal; the host passes the text.
]]

local M = {}

local function compile(input)
    local chunk = load('return ' .. input, '=console')
    if chunk then return chunk end
    return load(input, '=console')
end

--- Evaluates one line and prints its values or its error.
function M._evalExec(input)
    local chunk, message = compile(input)
    if not chunk then return addLog(420, message) end
    local results = table.pack(xpcall(chunk, debug.traceback))
    if not results[1] then return addLog(420, tostring(results[2])) end
    if results.n > 1 then print(getAsString(table.unpack(results, 2, results.n))) end
end

--- Evaluates one line and returns what it returns, as text; an error is returned as text starting with Error.
function M._evalExecRet(input)
    local chunk, message = compile(input)
    if not chunk then return 'Error: ' .. message end
    local results = table.pack(xpcall(chunk, debug.traceback))
    if not results[1] then return 'Error: ' .. tostring(results[2]) end
    return getAsString(table.unpack(results, 2, results.n))
end

local function resolvePath(path)
    local value = _G
    for name in path:gmatch('[^.]+') do
        if type(value) ~= 'table' then return nil end
        value = value[name]
    end
    return value
end

--- What may follow the word before position pos, as a list of names.
function M._getCompletion(input, pos)
    local word = input:sub(1, pos or #input):match('[%w_.]*$')
    local owner, prefix = word:match('^(.*)%.([^.]*)$')
    local container = owner and resolvePath(owner) or (not owner and _G)
    local names = {}
    if type(container) ~= 'table' then return names end
    for name in pairs(container) do
        if type(name) == 'string' and name:sub(1, #(prefix or word)) == (prefix or word) then names[#names + 1] = name end
    end
    table.sort(names)
    return names
end

local function infoOf(name)
    local ok, sim = xpcall(require, function() end, 'sim')
    return ok and name and sim.getApiInfo(-1, name) or ''
end

--- The signature of the function being called at position pos.
function M._getCalltip(input, pos) return infoOf(input:sub(1, pos or #input):match('([%w_.]+)%s*%([^()]*$')) end

--- Prints what is known about a function, given by name.
function M.help(what)
    if type(what) ~= 'string' then
        return print("usage: help 'sim.getObject' - the name of a function, as a string")
    end
    local info = infoOf(what)
    print(info and #info > 0 and info or 'no help on ' .. what)
end

local function hexLine(bytes, offset)
    local part = bytes:sub(offset + 1, offset + 16)
    local hex = part:gsub('.', function(c) return ('%02x '):format(c:byte()) end)
    return ('%08x  %-48s |%s|'):format(offset, hex, (part:gsub('[^\32-\126]', '.')))
end

--- Text of a string or buffer as offset, hexadecimal bytes and characters.
function M.hexdump(data)
    local bytes, lines = tostring(data), {}
    for offset = 0, #bytes - 1, 16 do lines[#lines + 1] = hexLine(bytes, offset) end
    print(table.concat(lines, '\n'))
end

--- Prints the bytes of a string or buffer in hexadecimal, on one line.
function M.printBytes(data)
    print((tostring(data):gsub('.', function(c) return ('%02x '):format(c:byte()) end):gsub(' $', '')))
end

return M
