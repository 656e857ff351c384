--[[
Reading JSON text, and quoting strings, for dkjson and json.

    scan(text, pos, nullval, objectmeta, arraymeta)     value, next position | nil, position, message
    quote(text)                                         "text"
    place(text, pos)                                    'line 1, column 5'
]]

local M = {}

local find, sub, byte = string.find, string.sub, string.byte
local MAX_DEPTH <const> = 500

---------------------------------------------------------------- quoting

local ESCAPES = {['"'] = '\\"', ['\\'] = '\\\\', ['\b'] = '\\b', ['\f'] = '\\f', ['\n'] = '\\n', ['\r'] = '\\r', ['\t'] = '\\t'}

local function escape(c)
    return ESCAPES[c] or ('\\u%.4x'):format(#c == 1 and byte(c) or utf8.codepoint(c))
end

-- Characters that are invisible or end a line of JavaScript.
local INVISIBLE = {'\u{ad}', '\u{600}', '\u{601}', '\u{602}', '\u{603}', '\u{604}', '\u{70f}', '\u{17b4}', '\u{17b5}', '\u{feff}'}

function M.quote(text)
    text = text:gsub('[%c"\\]', escape)
    if text:find('[\194\216\220\225\226\239]') then
        text = text:gsub('\194[\128-\159]', escape):gsub('\226\128[\140-\143\168-\175]', escape):gsub('\226\129[\160-\175]', escape)
        text = text:gsub('\239\191[\176-\191]', escape)
        for _, c in ipairs(INVISIBLE) do text = text:gsub(c, escape) end
    end
    return '"' .. text .. '"'
end

---------------------------------------------------------------- reading

function M.place(text, pos)
    local line, start = 1, 0
    for at in sub(text, 1, pos - 1):gmatch('()\n') do line, start = line + 1, at end
    return ('line %d, column %d'):format(line, pos - start)
end

local function fail(text, pos, message)
    error({pos = pos, message = message .. ' at ' .. M.place(text, pos)}, 0)
end

-- Position of what follows white space and comments; nil at the end of the text.
local function skip(text, pos)
    while true do
        pos = find(text, '%S', pos)
        if not pos then return nil end
        local two = sub(text, pos, pos + 1)
        if two == '//' then
            pos = find(text, '[\n\r]', pos + 2)
        elseif two == '/*' then
            pos = select(2, find(text, '*/', pos + 2, true))
        elseif sub(text, pos, pos + 2) == '\239\187\191' then
            pos = pos + 2
        else
            return pos
        end
        if not pos then return nil end
        pos = pos + 1
    end
end

local PLAIN = {['"'] = '"', ['/'] = '/', ['\\'] = '\\', b = '\b', f = '\f', n = '\n', r = '\r', t = '\t'}

-- The character of \uXXXX at pos (after the u), and where it ends.
local function unicode(text, pos)
    local code = tonumber('0x' .. (text:match('^%x%x%x%x', pos) or ''))
    if not code then return nil end
    if code >= 0xD800 and code <= 0xDBFF then
        local low = tonumber('0x' .. (text:match('^\\u(%x%x%x%x)', pos + 4) or ''))
        if low and low >= 0xDC00 and low <= 0xDFFF then
            return utf8.char(0x10000 + ((code - 0xD800) << 10) + low - 0xDC00), pos + 10
        end
    end
    return utf8.char(code), pos + 4
end

local function scanString(text, pos)
    local start, parts = pos, {}
    pos = pos + 1
    while true do
        local stop = find(text, '["\\]', pos)
        if not stop then fail(text, start, 'unterminated string') end
        parts[#parts + 1] = sub(text, pos, stop - 1)
        if byte(text, stop) == 34 then return table.concat(parts), stop + 1 end
        local letter = sub(text, stop + 1, stop + 1)
        local value, after = PLAIN[letter], stop + 2
        if letter == 'u' then value, after = unicode(text, stop + 2) end
        if not value then value, after = letter, stop + 2 end
        parts[#parts + 1] = value
        pos = after
    end
end

local WORDS = {['true'] = true, ['false'] = false}
local scanValue

local function scanItems(text, pos, depth, what, close, add)
    local start = pos
    if depth > MAX_DEPTH then fail(text, pos, 'nested too deeply') end
    pos = skip(text, pos + 1)
    if pos and sub(text, pos, pos) == close then return pos + 1 end
    while pos do
        pos = add(pos)
        local c = pos and sub(text, pos, pos)
        if c == close then return pos + 1 end
        if c == ',' then
            pos = skip(text, pos + 1)
            if pos and sub(text, pos, pos) == close then return pos + 1 end
        elseif pos then
            fail(text, pos, ("',' or '%s' expected"):format(close))
        end
    end
    fail(text, start, 'unterminated ' .. what)
end

local function scanArray(context, text, pos, depth)
    local array, n = setmetatable({}, context.arraymeta), 0
    return array, scanItems(text, pos, depth, 'array', ']', function(at)
        local value, after = scanValue(context, text, at, depth + 1)
        n = n + 1
        array[n] = value
        return skip(text, after)
    end)
end

local function scanObject(context, text, pos, depth)
    local object = setmetatable({}, context.objectmeta)
    return object, scanItems(text, pos, depth, 'object', '}', function(at)
        local key, after = scanValue(context, text, at, depth + 1)
        after = skip(text, after)
        if not after or byte(text, after) ~= 58 then fail(text, after or at, "':' expected") end
        after = skip(text, after + 1)
        if not after then fail(text, #text + 1, 'no valid JSON value (reached the end)') end
        if key == nil or key ~= key then fail(text, at, 'no valid key') end
        object[key], after = scanValue(context, text, after, depth + 1)
        return skip(text, after)
    end)
end

function scanValue(context, text, pos, depth)
    local c = sub(text, pos, pos)
    if c == '{' then return scanObject(context, text, pos, depth) end
    if c == '[' then return scanArray(context, text, pos, depth) end
    if c == '"' then return scanString(text, pos) end
    local first, last = find(text, '^%-?[%d%.]+[eE]?[%+%-]?%d*', pos)
    local number = first and tonumber(sub(text, first, last))
    if number then return number, last + 1 end
    local word = text:match('^%a%w*', pos)
    if word == 'null' then return context.nullval, pos + 4 end
    if WORDS[word] ~= nil then return WORDS[word], pos + #word end
    fail(text, pos, 'no valid JSON value')
end

function M.scan(text, pos, nullval, objectmeta, arraymeta)
    local start = skip(text, pos)
    if not start then return nil, #text + 1, 'no valid JSON value (reached the end)' end
    local context = {nullval = nullval, objectmeta = objectmeta, arraymeta = arraymeta}
    local ok, value, after = pcall(scanValue, context, text, start, 1)
    if ok then return value, after end
    if type(value) ~= 'table' or not value.pos then error(value, 0) end
    return nil, value.pos, value.message
end

return M
