-- topic: modules
-- as: sandbox
-- passes: 0
-- note: mime, over ltn12
local mime = require 'mime'
local ltn12 = require 'ltn12'
local function q(...)
    local t = table.pack(...)
    for i = 1, t.n do t[i] = type(t[i]) == 'string' and ('%q'):format(t[i]):gsub('\\\n', '\\n'):gsub('\\13', '\\r') or tostring(t[i]) end
    print(table.concat(t, ' '))
end
-- Chunks of every size must give the same.
local function through(text, size, ...)
    local chunks = {}
    for i = 1, #text, size do chunks[#chunks + 1] = text:sub(i, i + size - 1) end
    local out = {}
    local filter = select('#', ...) == 1 and ... or ltn12.filter.chain(...)
    assert(ltn12.pump.all(ltn12.source.chain(ltn12.source.table(chunks), filter), (ltn12.sink.table(out))))
    return table.concat(out)
end
local function all(text, make)
    local first = through(text, #text, make())
    for size = 1, 9 do assert(through(text, size, make()) == first, size) end
    if not first:find('[\128-\255]') then q(first) end
    return first
end
q(mime.b64('hello'))
q(mime.b64('hello', 'x'))
q(mime.b64('', nil))
q(mime.b64(nil, nil))
q(mime.unb64('aGVsbG8='))
q(mime.unb64('aGVs', 'b'))
local bytes = {}
for i = 0, 255 do bytes[#bytes + 1] = string.char(i) end
bytes = table.concat(bytes)
local encoded = all(bytes, function() return mime.encode('base64') end)
assert(all(encoded, function() return mime.decode('base64') end) == bytes)
assert(through(bytes, 7, mime.encode('base64'), mime.wrap('base64'), mime.decode('base64')) == bytes)
all(bytes, function() return mime.encode('base64'), mime.wrap('base64') end)
local text = 'Käse = süß \r\nblank \t\r\n.dot\r\n' .. ('long '):rep(30) .. 'end '
local quoted = all(text, function() return mime.encode('quoted-printable') end)
assert(all(quoted, function() return mime.decode('quoted-printable') end) == text)
local wrapped = all(text, function() return mime.encode('quoted-printable'), mime.wrap('quoted-printable') end)
for line in (wrapped .. '\r\n'):gmatch('(.-)\r\n') do assert(#line <= 76, line) end
all('a\r\nb', function() return mime.encode('quoted-printable', 'binary') end)
all('1\r2\n3\r\n4\n\r5\n\n6', function() return mime.normalize() end)
all('1\r2\n3\r\n4', function() return mime.normalize('|') end)
all('.a\r\n.\r\n..b\n.c', function() return mime.stuff() end)
all(('x'):rep(80) .. '\ny', function() return mime.wrap() end)
all('abcdefg', function() return mime.wrap('text', 3) end)
q(mime.wrp(3, 'abcdef', 3))
q(mime.wrp(3, nil, 3))
q(mime.wrp(2, nil, 3))
q(mime.qpwrp(76, nil))
q(mime.eol(0, nil))
q(mime.eol(13, '\nx'))
q(mime.dot(2, nil))
print(pcall(mime.encode, 'nonsense'))
print(pcall(mime.wrp, {}))
print(pcall(mime.wrp, 0, {}))
print(mime.wrp(0 / 0, 'ab', 0), mime.wrp(-1e300, 'ab', 1e300), mime.dot(1e9, '.'))
