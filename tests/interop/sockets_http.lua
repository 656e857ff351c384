-- Requests to the servers of sockets_http.py.
local http = require 'socket.http'
local https = require 'ssl.https'
local ssl = require 'ssl'
local socket = require 'socket'
local ltn12 = require 'ltn12'
local lfs = require 'lfs'
local checks = require 'sockets_checks'

local is, descriptors = checks.is, checks.descriptors
local function param(name) return sim.getNamedStringParam(name) end
local HTTP = 'http://127.0.0.1:' .. param('http')
local HTTPS = 'https://127.0.0.1:' .. param('https')
local ODD = 'http://127.0.0.1:' .. param('odd')
local CA = param('cafile')

-- The first request of all may make the resolver keep something.
http.request(HTTP .. '/plain')
local before = descriptors()

---------------------------------------------------------------- HTTP

local body, code, headers, status = http.request(HTTP .. '/plain')
is(body, 'hello world', 'body')
is(code, 200, 'code')
is(headers['content-type'], 'text/plain', 'header')
is(status, 'HTTP/1.1 200 OK', 'status')
body, code = http.request(HTTP .. '/nowhere')
is(body .. code, 'not here404', 'missing page')
body, code = http.request(HTTP .. '/large/3000000')
is(#body, 3000000, 'large body')
is(http.request(HTTP .. '/headers/User-Agent'), 'LuaSocket 3.0.0', 'user agent')
is(http.request(HTTP .. '/headers/Host'), '127.0.0.1:' .. param('http'), 'host')
is(http.request(HTTP .. '/redirect/3'), 'hello world', 'redirections')
body, code = http.request(HTTP .. '/redirect/9')
is(code, 302, 'too many redirections')
body, code = http.request(HTTP .. '/elsewhere/' .. ODD .. '/http10')
is(body, 'ten', 'redirection to another server')
_, code = http.request(HTTP .. '/elsewhere/gopher://x/')
is(code, 301, 'redirection to an unknown scheme')
body, code, headers = http.request(HTTP .. '/chunked')
is(body, 'hello world', 'chunks')
is(headers['x-trailer'], 'late', 'trailer')
is(http.request(HTTP .. '/closing'), 'until closed', 'until closed')
body, code = http.request(HTTP .. '/nothing')
is(body .. code, '204', 'no body')
body, code = http.request(HTTP .. '/secret')
is(code, 401, 'without a password')
is((http.request((HTTP:gsub('//', '//user:p%%40ss@')) .. '/secret')), 'come in', 'with a password')
body, code, headers = http.request(HTTP .. '/form', 'a=1&b=2')
is(body .. headers['x-type'], 'got a=1&b=2application/x-www-form-urlencoded', 'POST')

local parts = {}
local ok
ok, code = http.request{url = HTTP .. '/chunks', method = 'PUT', source = ltn12.source.string('in chunks'), sink = ltn12.sink.table(parts)}
is(ok, 1, 'generic form')
is(table.concat(parts), 'got in chunks', 'chunks sent')
ok, code, headers = http.request{url = HTTP .. '/large/10', method = 'HEAD'}
is(headers['content-length'] .. code, '10200', 'HEAD')
_, code = http.request{url = HTTP .. '/redirect/1', redirect = false}
is(code, 302, 'redirect = false')
ok, status = http.request{url = HTTP .. '/plain', sink = ltn12.sink.error('disk full')}
is(ok, nil, 'failing sink')
is(status, 'disk full', 'failing sink')
ok, status = http.request{url = HTTP .. '/form', method = 'POST', source = ltn12.source.error('no data')}
is(status, 'no data', 'failing source')
parts = {}
http.request{url = 'http://far.invalid/page?x', proxy = (HTTP:gsub('//', '//me:pw@')), sink = (ltn12.sink.table(parts))}
is(table.concat(parts), 'proxied http://far.invalid/page?x Basic bWU6cHc=', 'proxy')
http.PROXY = HTTP
is((http.request('http://far.invalid/')), 'proxied http://far.invalid/ None', 'the proxy of all')
http.PROXY = nil

---------------------------------------------------------------- failures

local function fails(url, expected)
    local result, message = http.request(url)
    is(result, nil, url)
    is(message, expected, url)
end
fails('http://127.0.0.1:' .. param('closed') .. '/', 'connection refused')
fails('http://nosuch.invalid/', 'host or service not provided, or not known')
fails('gopher://127.0.0.1/', "unknown scheme 'gopher'")
fails('http:///path', "invalid host 'nil'")
fails(ODD .. '/gone', 'closed')
fails(ODD .. '/gone-in-status', 'closed')
fails(ODD .. '/gone-in-headers', 'closed')
fails(ODD .. '/gone-in-body', 'closed')
fails(ODD .. '/gone-in-chunk', 'closed')
fails(ODD .. '/gone-before-chunk', 'closed')
fails(ODD .. '/bad-status', 'HTTP/1.1 what')
fails(ODD .. '/bad-header', 'malformed reponse headers')
fails(ODD .. '/bad-chunk', 'invalid chunk size')
fails(ODD .. '/huge-chunk', 'invalid chunk size')
fails(ODD .. '/endless-headers', 'too many headers')
fails(ODD .. '/endless-line', 'line too long')
is((http.request(ODD .. '/bad-length')), 'body', 'a length that is none')
_, _, headers = http.request(ODD .. '/folded')
is(headers['x-long'], 'one two, three', 'folded headers')
is((http.request(ODD .. '/continue')), 'ok', '100 Continue')
is((http.request(ODD .. '/http10')), 'ten', 'HTTP 1.0')
is((http.request(ODD .. '/http09')), '<html>of 1991</html>', 'HTTP 0.9')
is((http.request(ODD .. '/slow')), 'ok', 'byte by byte')
http.TIMEOUT = 0.1
fails(ODD .. '/silent', 'timeout')
http.TIMEOUT = 60

---------------------------------------------------------------- HTTPS

local function secure(request)
    local sunk = {}
    request.sink = ltn12.sink.table(sunk)
    local done, answer = https.request(request)
    return done and table.concat(sunk) or nil, answer
end
is(secure{url = HTTPS .. '/plain', cafile = CA}, 'hello world', 'https')
is(#secure{url = HTTPS .. '/large/1000000', cafile = CA}, 1000000, 'a large body by https')
is(secure{url = HTTPS .. '/redirect/1', cafile = CA}, 'hello world', 'redirection by https')
is(secure{url = HTTPS .. '/form', cafile = CA, method = 'POST', source = ltn12.source.string('data')}, 'got data', 'POST by https')
is((https.request(HTTPS .. '/plain')), nil, 'unknown authority')
is(select(2, https.request(HTTPS .. '/plain')):find('certificate', 1, true) ~= nil, true, 'unknown authority')
is(secure{url = HTTPS .. '/plain', verify = 'none'}, 'hello world', 'without verification')
is(secure{url = 'https://127.0.0.1:' .. param('wrong') .. '/plain', cafile = CA}, nil, 'wrong name')
is(secure{url = 'https://127.0.0.1:' .. param('wrong') .. '/plain', verify = 'none'}, 'hello world', 'wrong name without verification')
parts = {}
ok, code = http.request{url = HTTPS .. '/plain', cafile = CA, sink = (ltn12.sink.table(parts))}
is(table.concat(parts), 'hello world', 'https through socket.http')
parts = {}
http.request{url = HTTP .. '/elsewhere/' .. HTTPS .. '/plain', cafile = CA, sink = (ltn12.sink.table(parts))}
is(table.concat(parts), 'hello world', 'redirection to https')
is(select(2, https.request(HTTP:gsub('http:', 'https:') .. '/')) ~= nil, true, 'a server without TLS')
is(select(2, https.request('https://127.0.0.1:' .. param('closed') .. '/')), 'connection refused', 'nobody')
is(select(2, https.request{url = HTTPS .. '/plain', cafile = '/nonexistent'}), 'error loading certificate (/nonexistent)', 'cafile')
is(select(2, https.request{url = HTTPS, create = socket.tcp}), 'create function not permitted', 'create')

-- Both ends of a connection in one script.
local server = socket.bind('127.0.0.1', 0)
local _, port = server:getsockname()
local near = socket.connect('127.0.0.1', port)
local far = server:accept()
near = ssl.wrap(near, {mode = 'client', cafile = CA, host = 'localhost'})
far = ssl.wrap(far, {mode = 'server', certificate = param('certificate'), key = param('key')})
is(tostring(near):match('^SSL connection: 0x%x+$') ~= nil, true, 'tostring')
near:settimeout(0)
far:settimeout(0)
local nearDone, farDone
for _ = 1, 1000 do
    nearDone = nearDone or near:dohandshake()
    farDone = farDone or far:dohandshake()
    if nearDone and farDone then break end
    socket.select({near, far}, nil, 0.01)
end
is(nearDone and farDone, true, 'handshake step by step')
near:settimeout(5)
far:settimeout(5)
is(near:send('line\nrest'), 9, 'send')
is(far:receive(), 'line', 'receive')
is(far:dirty(), true, 'dirty')
is(#socket.select({far}, nil, 5), 1, 'select sees what is decrypted')
is(near:info('protocol'), 'TLSv1.3', 'info')
near:close()
is(far:receive('*a'), 'rest', 'the rest')
is(select(2, far:receive()), 'closed', 'closed')
far:close()
server:close()
is(select(2, ssl.wrap(socket.tcp4(), {mode = 'odd'})), 'invalid mode (odd)', 'mode')

is(descriptors(), before, 'descriptors')
