--[[
Requests by HTTP, and by HTTPS with `ssl.https`.

    request(url, body)      body, code, headers (names in small letters), status line; a POST when there is a body
    request{url=, method=, headers=, source=, sink=, step=, proxy=, redirect=, maxredirects=, create=, user=, password=}
                            1, code, headers, status line; the answer goes into the sink
    open(host, port, create)    the parts of a request one by one
    TIMEOUT, USERAGENT, PROXY, SCHEMES

Failures are results: nil and the reason. More than 1000 headers, or header lines and chunk sizes longer than 64 KiB, are a failure.
]]

local socket = require('socket')
local url = require('socket.url')
local ltn12 = require('ltn12')
local mime = require('mime')
local canonic = require('socket.headers').canonic

local http = {TIMEOUT = 60, USERAGENT = socket._VERSION}

local MAX_HEADERS <const> = 1000
local MAX_LINE_LENGTH <const> = 65536
local MAX_REDIRECTS <const> = 5

-- What makes a connection for a scheme.
http.SCHEMES = {
    http = {port = 80, create = function() return socket.tcp end},
    https = {port = 443, create = function(request) return require('ssl.https').tcp(request) end},
}
http.schemes = http.SCHEMES

---------------------------------------------------------------- reading

-- A line, unless it does not end in time.
local function receiveLine(c)
    local line, message = c:receive()
    if line and #line > MAX_LINE_LENGTH then return nil, 'line too long' end
    return line, message
end

local function receiveHeaders(c, headers)
    headers = headers or {}
    local last
    for _ = 1, MAX_HEADERS do
        local line, message = receiveLine(c)
        if not line then return nil, message end
        if line == '' then return headers end
        local name, value = line:match('^([^%s:][^:]-)%s*:%s*(.-)%s*$')
        if name then
            last = name:lower()
            headers[last] = headers[last] and headers[last] .. ', ' .. value or value
        elseif last and line:find('^%s') then
            headers[last] = headers[last] .. ' ' .. line:match('^%s*(.-)%s*$')
        else
            return nil, 'malformed reponse headers'
        end
    end
    return nil, 'too many headers'
end

-- Chunks with their sizes; at the end trailing headers.
socket.sourcet['http-chunked'] = function(c, headers)
    local ended
    return function()
        if ended then return nil end
        local line, message = receiveLine(c)
        if not line then return nil, message end
        local digits = line:match('^%s*0*(%x+)%s*;?')
        -- More digits than these are no size that anybody could send.
        if not digits or #digits > 12 then return nil, 'invalid chunk size' end
        local size = tonumber('0x' .. digits)
        if size == 0 then
            ended = true
            local trailers, failure = receiveHeaders(c, headers)
            if not trailers then return nil, failure end
            return nil
        end
        local chunk, failure = c:receive(size)
        if not chunk then return nil, failure end
        local rest
        rest, failure = receiveLine(c)
        if not rest then return nil, failure end
        return chunk
    end
end

socket.sinkt['http-chunked'] = function(c)
    return function(chunk)
        if not chunk then return c:send('0\r\n\r\n') end
        if chunk == '' then return 1 end
        return c:send(('%X\r\n%s\r\n'):format(#chunk, chunk))
    end
end

---------------------------------------------------------------- one exchange

local Exchange = {}
Exchange.__index = Exchange

function Exchange:sendrequestline(method, uri)
    return self.try(self.c:send(('%s %s HTTP/1.1\r\n'):format(method or 'GET', uri)))
end

function Exchange:sendheaders(headers)
    local lines = {}
    for name, value in pairs(headers) do
        lines[#lines + 1] = ('%s: %s\r\n'):format(canonic[tostring(name):lower()] or name, value)
    end
    table.sort(lines)
    lines[#lines + 1] = '\r\n'
    return self.try(self.c:send(table.concat(lines)))
end

function Exchange:sendbody(headers, source, step)
    source = source or ltn12.source.empty()
    local how = headers['content-length'] and 'keep-open' or 'http-chunked'
    return self.try(ltn12.pump.all(source, socket.sink(how, self.c), step or ltn12.pump.step))
end

-- Code and status line; no code when the server speaks the protocol of 1991.
function Exchange:receivestatusline()
    local status, message = self.c:receive(5)
    if status ~= 'HTTP/' then
        if not status and message ~= 'closed' then self.try(nil, message) end
        if not status then self.try(nil, message) end
        return nil, status
    end
    local line = self.try(receiveLine(self.c))
    status = status .. line
    return self.try(tonumber(status:match('HTTP/%d*%.%d* (%d%d%d)')), status)
end

function Exchange:receiveheaders() return self.try(receiveHeaders(self.c)) end

function Exchange:receivebody(headers, sink, step)
    local encoding = headers['transfer-encoding']
    local length = tonumber(headers['content-length'])
    local how = 'default'
    if encoding and encoding ~= 'identity' then
        how = 'http-chunked'
    elseif length then
        how = 'by-length'
    end
    local source = socket.source(how, self.c, how == 'http-chunked' and headers or length)
    return self.try(ltn12.pump.all(source, sink or ltn12.sink.null(), step or ltn12.pump.step))
end

function Exchange:receive09body(status, sink, step)
    local source = ltn12.source.rewind(socket.source('until-closed', self.c))
    source(status)
    return self.try(ltn12.pump.all(source, sink or ltn12.sink.null(), step or ltn12.pump.step))
end

function Exchange:close() return self.c:close() end

-- @api table exchange = socket.http.open(string host, any port = 80, func create = nil)
function http.open(host, port, create)
    local c = socket.try((create or socket.tcp)())
    local exchange = setmetatable({c = c}, Exchange)
    exchange.try = socket.newtry(function() exchange:close() end)
    exchange.try(c:settimeout(http.TIMEOUT))
    exchange.try(c:connect(host, port))
    return exchange
end

---------------------------------------------------------------- requests

-- What goes into the request line: the whole URL for a proxy.
local function requestUri(request)
    local parts = {path = request.path, params = request.params, query = request.query, fragment = request.fragment}
    if request.viaProxy then
        parts.scheme, parts.host, parts.port = request.scheme, request.host, request.port
    else
        parts.fragment = nil
    end
    return url.build(parts)
end

local function basic(user, password)
    return 'Basic ' .. mime.b64(url.unescape(user) .. ':' .. url.unescape(password or ''))
end

local function defaultHeaders(request)
    local host = request.host:find(':', 1, true) and '[' .. request.host .. ']' or request.host
    if request.port and tonumber(request.port) ~= http.SCHEMES[request.scheme].port then host = host .. ':' .. request.port end
    local headers = {['user-agent'] = http.USERAGENT, host = host, connection = 'close, TE', te = 'trailers'}
    if request.user and request.password then headers.authorization = basic(request.user, request.password) end
    if request.proxyUser then headers['proxy-authorization'] = basic(request.proxyUser, request.proxyPassword) end
    for name, value in pairs(request.givenHeaders or {}) do headers[name:lower()] = value end
    if request.source and not headers['content-length'] then
        headers['transfer-encoding'] = headers['transfer-encoding'] or 'chunked'
    end
    return headers
end

-- Where to connect to: the proxy, if there is one.
local function adjustProxy(request)
    local proxy = request.proxy or http.PROXY
    if not proxy then return request.host, request.port end
    if request.scheme ~= 'http' then socket.try(nil, 'proxy not supported') end
    proxy = socket.try(url.parse(proxy))
    request.viaProxy, request.proxyUser, request.proxyPassword = true, proxy.user, proxy.password
    socket.try(proxy.host, 'invalid proxy')
    return proxy.host, proxy.port or 3128
end

-- The request with everything that follows from its URL.
local function adjust(asked)
    local request = {}
    if asked.url then request = socket.try(url.parse(asked.url, {path = '/', scheme = 'http'})) end
    for name, value in pairs(asked) do request[name] = value end
    request.scheme = (request.scheme or 'http'):lower()
    local scheme = http.SCHEMES[request.scheme]
    if not scheme then socket.try(nil, ("unknown scheme '%s'"):format(request.scheme)) end
    if not request.host or request.host == '' then
        socket.try(nil, ("invalid host '%s'"):format(tostring(request.host)))
    end
    request.path = request.path or '/'
    request.givenHeaders = asked.headers
    local connectPort
    request.connectHost, connectPort = adjustProxy(request)
    request.connectPort = connectPort or scheme.port
    request.headers = defaultHeaders(request)
    request.create = request.create or scheme.create(request)
    return request
end

local REDIRECTS <const> = {[301] = true, [302] = true, [303] = true, [307] = true, [308] = true}

local function isRedirected(request, code, headers)
    local location = headers.location
    if not location or location:gsub('%s', '') == '' then return false end
    local scheme = location:match('^([%w][%w%+%-%.]*):')
    if scheme and not http.SCHEMES[scheme:lower()] then return false end
    return request.redirect ~= false and REDIRECTS[code]
        and (not request.method or request.method == 'GET' or request.method == 'HEAD')
        and (request.redirects or 0) < (request.maxredirects or MAX_REDIRECTS)
end

local function hasBody(request, code)
    return request.method ~= 'HEAD' and code ~= 204 and code ~= 304 and not (code >= 100 and code < 200)
end

local perform

local function follow(request, location)
    local answer, code, headers, status = perform({
        url = url.absolute(request.url or url.build(request), location), source = request.source, sink = request.sink,
        headers = request.givenHeaders, proxy = request.proxy, maxredirects = request.maxredirects,
        redirects = (request.redirects or 0) + 1, create = request.givenCreate, method = request.method, step = request.step,
        verify = request.verify, cafile = request.cafile, certificate = request.certificate, key = request.key,
    })
    headers = headers or {}
    headers.location = headers.location or location
    return answer, code, headers, status
end

function perform(asked)
    local request = adjust(asked)
    request.givenCreate = asked.create
    local exchange = http.open(request.connectHost, request.connectPort, request.create)
    exchange:sendrequestline(request.method, requestUri(request))
    exchange:sendheaders(request.headers)
    if request.source then exchange:sendbody(request.headers, request.source, request.step) end
    local code, status = exchange:receivestatusline()
    if not code then
        exchange:receive09body(status, request.sink, request.step)
        exchange:close()
        return 1, 200
    end
    local headers
    while code == 100 do
        exchange:receiveheaders()
        code, status = exchange:receivestatusline()
    end
    headers = exchange:receiveheaders()
    if isRedirected(request, code, headers) and not request.source then
        exchange:close()
        return follow(request, headers.location)
    end
    if hasBody(request, code) then exchange:receivebody(headers, request.sink, request.step) end
    exchange:close()
    return 1, code, headers, status
end

-- The table of a simple request.
local function simple(address, body)
    local parts = {}
    local request = {url = address, sink = ltn12.sink.table(parts), parts = parts}
    if body then
        request.source = ltn12.source.string(body)
        request.method = 'POST'
        request.headers = {['content-length'] = #body, ['content-type'] = 'application/x-www-form-urlencoded'}
    end
    return request
end

http.genericform = simple

-- @api any body, int code, table headers, string status = socket.http.request(any url, string body = nil)
http.request = socket.protect(function(address, body)
    if type(address) ~= 'string' then return perform(address) end
    local request = simple(address, body)
    local _, code, headers, status = perform(request)
    return table.concat(request.parts), code, headers, status
end)

return http
