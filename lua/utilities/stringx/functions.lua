--[[
The functions of the module stringx. They come into the global string the first time one of them is asked for. They count bytes, not
characters, except utf8sub.
]]

local M = {}

--- Splits at any character class, but not inside quotes.
-- @api string[] parts = stringx.qsplit(string s, string pattern = '%s')
function M.qsplit(s, pattern)
    local result, current, quote = {}, {}, nil
    for c in s:gmatch('.') do
        if quote then
            if c == quote then quote = nil else current[#current + 1] = c end
        elseif c == '"' or c == "'" then
            quote = c
        elseif c:find(pattern or '%s') then
            if #current > 0 then result[#result + 1] = table.concat(current) end
            current = {}
        else
            current[#current + 1] = c
        end
    end
    if #current > 0 then result[#result + 1] = table.concat(current) end
    return result
end

--- Iterator over the parts of text between matches of pattern.
-- @api func next = stringx.gsplit(string text, string pattern, bool plain = false)
function M.gsplit(text, pattern, plain)
    local start, done = 1, false
    return function()
        if done then return nil end
        local first, last = text:find(pattern, start, plain)
        if not first or last < first then
            done = true
            return text:sub(start)
        end
        local part = text:sub(start, first - 1)
        start = last + 1
        return part
    end
end

--- The parts of a text between matches of a pattern.
-- @api string[] parts = stringx.split(string text, string pattern, bool plain = false)
function M.split(text, pattern, plain)
    local result = {}
    for part in M.gsplit(text, pattern, plain) do result[#result + 1] = part end
    return result
end

--- Whether a text starts with another.
-- @api bool result = stringx.startswith(string s, string prefix)
function M.startswith(s, prefix) return s:sub(1, #prefix) == prefix end

--- Whether a text ends with another.
-- @api bool result = stringx.endswith(string s, string suffix)
function M.endswith(s, suffix) return suffix == '' or s:sub(-#suffix) == suffix end

--- Removes white space at both ends.
-- @api string result = stringx.trim(string s)
function M.trim(s) return (s:match('^%s*(.-)%s*$')) end

--- Removes white space at the start.
-- @api string result = stringx.ltrim(string s)
function M.ltrim(s) return (s:gsub('^%s+', '')) end

--- Removes white space at the end.
-- @api string result = stringx.rtrim(string s)
function M.rtrim(s) return s:match('^(.-)%s*$') end

--- The characters of a text (bytes).
-- @api string[] result = stringx.chars(string s)
function M.chars(s)
    local result = {}
    for i = 1, #s do result[i] = s:sub(i, i) end
    return result
end

--- The numbers of the bytes of a text.
-- @api int[] result = stringx.bytes(string s)
function M.bytes(s)
    local result = {}
    for i = 1, #s do result[i] = s:byte(i) end
    return result
end

--- Escapes what is magic in a pattern.
-- @api string result = stringx.escpat(string s)
function M.escpat(s) return (s:gsub('[%^%$%(%)%%%.%[%]%*%+%-%?]', '%%%0')) end

--- The text if it consists of letters and digits, else nil.
-- @api string result = stringx.isalnum(string s)
function M.isalnum(s) return s:match('^%w+$') end

--- The text if it consists of letters, else nil.
-- @api string result = stringx.isalpha(string s)
function M.isalpha(s) return s:match('^%a+$') end

--- The text if it is a Lua name, else nil.
-- @api string result = stringx.isidentifier(string s)
function M.isidentifier(s) return s:match('^[%a_][%w_]*$') end

--- Whether a text has no upper-case letters.
-- @api bool result = stringx.islower(string s)
function M.islower(s) return s == s:lower() end

--- The text if it consists of digits, else nil.
-- @api string result = stringx.isnumeric(string s)
function M.isnumeric(s) return s:match('^%d+$') end

--- Whether a text consists of printable characters.
-- @api bool result = stringx.isprintable(string s)
function M.isprintable(s) return s:find('^[%g ]*$') ~= nil end

--- The text if it consists of white space, else nil.
-- @api string result = stringx.isspace(string s)
function M.isspace(s) return s:match('^%s+$') end

--- Whether a text has no lower-case letters.
-- @api bool result = stringx.isupper(string s)
function M.isupper(s) return s == s:upper() end

--- The text with an upper-case first letter.
-- @api string result = stringx.capitalize(string s)
function M.capitalize(s) return (s:gsub('^%l', string.upper)) end

--- Escapes backslashes, newlines and the quote used around the text.
-- @api string result = stringx.escapequotes(string s, string context = nil)
function M.escapequotes(s, context)
    context = context or "'"
    return (s:gsub('\\', '\\\\'):gsub('\n', '\\n'):gsub(M.escpat(context), '\\%0'))
end

local ENTITIES = {['&'] = '&amp;', ['<'] = '&lt;', ['>'] = '&gt;', ['"'] = '&quot;', ["'"] = '&#39;'}

--- Replaces the special characters of HTML; with opts.entities = false only < and >.
-- @api string result = stringx.escapehtml(string s, table opts = {})
function M.escapehtml(s, opts)
    if opts and opts.entities == false then return (s:gsub('[<>]', ENTITIES)) end
    return (s:gsub('[&<>"\']', ENTITIES))
end

--- Removes the marks of Markdown; opts.keeplinks keeps links.
-- @api string result = stringx.stripmarkdown(string s, table opts = {})
function M.stripmarkdown(s, opts)
    if not (opts and opts.keeplinks) then s = s:gsub('!?%[(.-)%]%(.-%)', '%1') end
    s = s:gsub('%*%*(.-)%*%*', '%1'):gsub('__(.-)__', '%1'):gsub('%*(.-)%*', '%1'):gsub('`(.-)`', '%1')
    return (s:gsub('^#+%s*', ''):gsub('\n#+%s*', '\n'))
end

local function xmlAttributes(node, order)
    local names, known = {}, {}
    for _, name in ipairs(order or {}) do
        if node[name] ~= nil then names[#names + 1] = name end
        known[name] = true
    end
    local rest = {}
    for name in pairs(node) do
        if type(name) == 'string' and name ~= 'tag' and not known[name] then rest[#rest + 1] = name end
    end
    table.sort(rest)
    table.move(rest, 1, #rest, #names + 1, names)
    local parts = {}
    for i, name in ipairs(names) do parts[i] = (' %s="%s"'):format(name, M.escapehtml(tostring(node[name]))) end
    return table.concat(parts)
end

--- Text of {tag = 'a', attribute = 'x', child, 'text', ...}.
-- @api string text = stringx.renderxml(any node, string[] order = {})
function M.renderxml(node, order)
    if type(node) ~= 'table' then return M.escapehtml(tostring(node)) end
    local tag = node.tag or 'node'
    if #node == 0 then return '<' .. tag .. xmlAttributes(node, order) .. '/>' end
    local parts = {}
    for i, child in ipairs(node) do parts[i] = M.renderxml(child, order) end
    return '<' .. tag .. xmlAttributes(node, order) .. '>' .. table.concat(parts) .. '</' .. tag .. '>'
end

--- The rest of a text after a prefix; no value where it begins otherwise.
-- @api string result = stringx.stripprefix(string s, string prefix)
function M.stripprefix(s, prefix)
    if M.startswith(s, prefix) then return s:sub(#prefix + 1) end
end

--- The beginning of a text before a suffix; no value where it ends otherwise.
-- @api string result = stringx.stripsuffix(string s, string suffix)
function M.stripsuffix(s, suffix)
    if M.endswith(s, suffix) then return s:sub(1, #s - #suffix) end
end

--- Shortens to maxLen, ending in three dots.
-- @api string result = stringx.elide(string s, int maxLen = 80, table opts = {})
function M.elide(s, maxLen, opts)
    maxLen = maxLen or 80
    local line = opts and opts.truncateAtNewLine and s:match('^(.-)\n')
    if line then return #line + 3 <= maxLen and line .. '...' or line:sub(1, maxLen - 3) .. '...' end
    return #s <= maxLen and s or s:sub(1, math.max(0, maxLen - 3)) .. '...'
end

--- Like sub, counting UTF-8 characters.
-- @api string result = stringx.utf8sub(string s, int i, int j = #s)
function M.utf8sub(s, i, j)
    local n = utf8.len(s)
    i, j = i < 0 and math.max(n + i + 1, 1) or math.max(i, 1), j or n
    if j < 0 then j = n + j + 1 end
    j = math.min(j, n)
    if i > j then return '' end
    return s:sub(utf8.offset(s, i), utf8.offset(s, j + 1) - 1)
end

-- Width on a terminal: characters, or bytes where the text is not UTF-8.
function M._len(s) return utf8.len(s) or #s end

--- Fills with blanks up to width; a negative width aligns to the right.
-- @api string result = stringx.pad(string s, int width, bool clip = false)
function M.pad(s, width, clip)
    local missing = math.abs(width) - M._len(s)
    if missing < 0 then return clip and M.utf8sub(s, 1, math.abs(width)) or s end
    return width < 0 and (' '):rep(missing) .. s or s .. (' '):rep(missing)
end

--- Width and height of a text of several lines.
-- @api int width, int height = stringx.blocksize(string block)
function M.blocksize(block)
    local width, lines = 0, M.split(block, '\n', true)
    for _, line in ipairs(lines) do width = math.max(width, M._len(line)) end
    return width, #lines
end

--- Fills a text of several lines with spaces and lines, up to a width and a height.
-- @api string result = stringx.blockpad(string block, int width = nil, int height = nil, bool clip = false)
function M.blockpad(block, width, height, clip)
    local ownWidth, ownHeight = M.blocksize(block)
    width, height = width or ownWidth, height or ownHeight
    local lines = M.split(block, '\n', true)
    for i = 1, math.max(height, #lines) do lines[i] = M.pad(lines[i] or '', width, clip) end
    if clip then lines = table.move(lines, 1, height, 1, {}) end
    return table.concat(lines, '\n')
end

--- Puts blocks of text side by side.
-- @api string result = stringx.blockhstack(string[] blocks, int spacing = 1)
function M.blockhstack(blocks, spacing)
    local height, columns = 0, {}
    for _, block in ipairs(blocks) do height = math.max(height, select(2, M.blocksize(block))) end
    for i, block in ipairs(blocks) do columns[i] = M.split(M.blockpad(block, nil, height), '\n', true) end
    local lines = {}
    for row = 1, height do
        local parts = {}
        for i, column in ipairs(columns) do parts[i] = column[row] end
        lines[row] = table.concat(parts, (' '):rep(spacing or 1))
    end
    return table.concat(lines, '\n')
end

function M.unittest()
    assert(table.concat(M.split('a,b,,c', ','), '|') == 'a|b||c' and #M.qsplit('a "b c" d') == 3)
    assert(M.trim('  a b ') == 'a b' and M.startswith('abc', 'ab') and M.endswith('abc', 'bc') and not M.endswith('abc', 'b'))
    assert(M.utf8sub('aéb', 2, 2) == 'é' and M.pad('a', 3) == 'a  ' and M.elide('abcdef', 5) == 'ab...')
    print(debug.getinfo(1, 'S').source, 'tests passed')
end

return M
