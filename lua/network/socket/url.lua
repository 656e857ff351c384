--[[
URLs: taken apart, put together, made absolute.

    parse(url, default)         table of scheme, authority, userinfo, user, password, host, port, path, params, query, fragment
    build(parsed)               the other way
    absolute(base, relative)    base and relative may be tables of parse
    parse_path(path), build_path(segments, unsafe)      is_absolute and is_directory are fields of the list
    escape(text), unescape(text)
]]

local url = {_VERSION = 'URL 1.0.3'}

-- @api string escaped = socket.url.escape(string text)
function url.escape(text)
    return (text:gsub('[^A-Za-z0-9_]', function(letter) return ('%%%02x'):format(letter:byte()) end))
end

-- @api string text = socket.url.unescape(string text)
function url.unescape(text)
    return (text:gsub('%%(%x%x)', function(digits) return string.char(tonumber('0x' .. digits)) end))
end

-- What may stand in a segment of a path as it is.
local function escapeSegment(text)
    return (text:gsub("[^A-Za-z0-9%-_%.!~%*'%(%):@&=%+%$,]", function(letter) return ('%%%02x'):format(letter:byte()) end))
end

---------------------------------------------------------------- parse, build

-- Cuts what `pattern` matches off the text; the capture goes into the field.
local function cut(text, pattern, parsed, field)
    local from, to, part = text:find(pattern)
    if not from then return text end
    parsed[field] = part
    return text:sub(1, from - 1) .. text:sub(to + 1)
end

local function parseAuthority(parsed)
    local rest = parsed.authority
    if not rest then return end
    rest = cut(rest, '^([^@]*)@', parsed, 'userinfo')
    rest = cut(rest, ':([^:%]]*)$', parsed, 'port')
    if parsed.port == '' then parsed.port = nil end
    if rest ~= '' then parsed.host = rest:match('^%[(.+)%]$') or rest end
    local info = parsed.userinfo
    if not info then return end
    parsed.user, parsed.password = info:match('^([^:]*):(.*)$')
    parsed.user = parsed.user or info
end

-- @api table parsed = socket.url.parse(string url, table default = nil)
function url.parse(text, default)
    local parsed = {}
    for name, value in pairs(default or {}) do parsed[name] = value end
    if not text or text == '' then return nil, 'invalid url' end
    text = cut(text, '#(.*)$', parsed, 'fragment')
    text = cut(text, '^([%w][%w%+%-%.]*):', parsed, 'scheme')
    text = cut(text, '^//([^/%?]*)', parsed, 'authority')
    text = cut(text, '%?(.*)$', parsed, 'query')
    text = cut(text, ';(.*)$', parsed, 'params')
    if text ~= '' then parsed.path = text end
    parseAuthority(parsed)
    return parsed
end

local function buildAuthority(parsed)
    if not parsed.host then return parsed.authority end
    local authority = parsed.host:find(':', 1, true) and '[' .. parsed.host .. ']' or parsed.host
    if parsed.port then authority = authority .. ':' .. tostring(parsed.port) end
    local info = parsed.userinfo
    if parsed.user then info = parsed.user .. (parsed.password and ':' .. parsed.password or '') end
    return info and info .. '@' .. authority or authority
end

-- @api string url = socket.url.build(table parsed)
function url.build(parsed)
    local text = parsed.path or ''
    if parsed.params then text = text .. ';' .. parsed.params end
    if parsed.query then text = text .. '?' .. parsed.query end
    local authority = buildAuthority(parsed)
    if authority then
        if text ~= '' and not text:find('^[/;%?]') then text = '/' .. text end
        text = '//' .. authority .. text
    end
    if parsed.scheme then text = parsed.scheme .. ':' .. text end
    if parsed.fragment then text = text .. '#' .. parsed.fragment end
    return text
end

---------------------------------------------------------------- relative URLs (RFC 3986, 5.2)

-- The path without `.` and `..` segments.
local function withoutDots(path)
    local kept, isDirectory = {}, false
    local isAbsolute = path:sub(1, 1) == '/'
    for segment in path:gmatch('[^/]*') do
        isDirectory = segment == '.' or segment == '..' or segment == ''
        if segment == '..' then
            if #kept > 0 then kept[#kept] = nil end
        elseif segment ~= '.' and (segment ~= '' or #kept > 0) then
            kept[#kept + 1] = segment
        end
    end
    if kept[#kept] == '' then kept[#kept] = nil end
    local joined = table.concat(kept, '/')
    if isDirectory and joined ~= '' then joined = joined .. '/' end
    return (isAbsolute and '/' or '') .. joined
end

local function absolutePath(base, relative)
    if relative:sub(1, 1) == '/' then return withoutDots(relative) end
    return withoutDots(base:gsub('[^/]*$', '') .. relative)
end

-- Fields a relative URL takes from its base, one kind after the other, until it has one of its own.
local function inherit(relative, base)
    relative.scheme = base.scheme
    if relative.authority then
        relative.path = relative.path and withoutDots(relative.path)
        return
    end
    for _, name in ipairs({'authority', 'userinfo', 'user', 'password', 'host', 'port'}) do relative[name] = base[name] end
    if relative.path then
        relative.path = absolutePath(base.path or (base.authority and '/' or ''), relative.path)
        return
    end
    relative.path = base.path
    if relative.params then return end
    relative.params = base.params
    relative.query = relative.query or base.query
end

-- @api string url = socket.url.absolute(any base, any relative)
function url.absolute(base, relative)
    local parsedBase = type(base) == 'table' and base or url.parse(base)
    local baseText = type(base) == 'table' and url.build(base) or base
    local parsed = type(relative) == 'table' and url.parse(url.build(relative)) or url.parse(relative)
    if not parsedBase then return type(relative) == 'table' and url.build(relative) or relative end
    if not parsed then return baseText end
    if parsed.scheme then return type(relative) == 'table' and url.build(relative) or relative end
    inherit(parsed, parsedBase)
    return url.build(parsed)
end

---------------------------------------------------------------- paths

-- @api table segments = socket.url.parse_path(string path)
function url.parse_path(path)
    local segments = {}
    path = path or ''
    for segment in path:gmatch('[^/]+') do segments[#segments + 1] = url.unescape(segment) end
    if path:sub(1, 1) == '/' then segments.is_absolute = 1 end
    if path:sub(-1) == '/' then segments.is_directory = 1 end
    return segments
end

-- @api string path = socket.url.build_path(table segments, bool unsafe = false)
function url.build_path(segments, unsafe)
    local escaped = {}
    for i, segment in ipairs(segments) do escaped[i] = unsafe and segment or escapeSegment(segment) end
    local path = table.concat(escaped, '/')
    if segments.is_directory and #escaped > 0 then path = path .. '/' end
    if segments.is_absolute then path = '/' .. path end
    return path
end

return url
