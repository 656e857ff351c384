-- topic: modules
-- as: sandbox
-- passes: 0
-- note: socket.url; the references are the examples of RFC 3986, 5.4
local url = require 'socket.url'
local BASE = 'http://a/b/c/d;p?q'
for reference in ([[g:h g ./g g/ /g //g ?y g?y #s g#s g?y#s ;x g;x g;x?y#s . ./ .. ../ ../g ../.. ../../ ../../g ../../../g /./g
/../g g. .g g.. ..g ./../g ./g/. g/./h g/../h g;x=1/./y g?y/./x]]):gmatch('%S+') do
    print(reference, url.absolute(BASE, reference))
end
print(url.absolute(BASE, ''), url.absolute('http://h', 'x'), url.absolute({scheme = 'http', host = 'h', path = '/a/b'}, {path = 'c'}))
local function show(text, default)
    local parsed, message = url.parse(text, default)
    if not parsed then return print(text, parsed, message) end
    local fields = {}
    for name, value in pairs(parsed) do fields[#fields + 1] = name .. '=' .. value end
    table.sort(fields)
    print(text, table.concat(fields, ' '), url.build(parsed))
end
show 'http://user:pass@host.org:8080/a/b;type=i?x=1&y=2#part'
show 'ftp://user@host/'
show 'http://[::1]:80/x'
show 'http://[fe80::1]/'
show '//host/path?q'
show 'path/only'
show 'mailto:someone@example.org'
show 'http://host?query'
show 'http://host:/x'
show '#fragment'
show('host-less/x', {scheme = 'http', host = 'default'})
print(url.parse(''), url.parse(nil))
print(url.escape('a b/é_-.~'), url.unescape('a%20b%2f%C3%a9+%zz%4'))
local segments = url.parse_path('/a%20b//c;d/')
print(#segments, segments[1], segments[2], segments.is_absolute, segments.is_directory)
print(url.build_path(segments), url.build_path({'x y', 'z'}), url.build_path({'x y', is_absolute = 1}, true), url.build_path({is_absolute = 1}))
print(url.build({scheme = 'http', host = '::1', port = 81, user = 'u', password = 'p', path = 'x'}), url.build({path = '/x'}))
