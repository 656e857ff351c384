--[[
Requests by HTTPS: `socket.http` over TLS.

    request(url, body)          as http.request; the certificate of the server is verified
    request{url=, ..., verify=, cafile=, certificate=, key=}
    tcp(params)                 what makes connections, for http's `create`
    PORT, TIMEOUT
]]

local socket = require('socket')
local ssl = require('ssl')
local url = require('socket.url')
local http = require('socket.http')
local ltn12 = require('ltn12')

local https = {PORT = 443, TIMEOUT = 60, _VERSION = ssl._VERSION}

local Connection = {}

-- What is not here is a method of the TLS object, once there is one, or of the plain one.
function Connection.__index(connection, name)
    local own = Connection[name]
    if own then return own end
    return function(_, ...)
        local object = rawget(connection, 'object')
        return object[name](object, ...)
    end
end

function Connection:connect(host, port)
    local ok, message = self.object:connect(host, port)
    if not ok then return nil, message end
    local wrapped
    wrapped, message = ssl.wrap(self.object, self.params)
    if not wrapped then return nil, message end
    self.object = wrapped
    wrapped:settimeout(self.timeout)
    wrapped:sni(self.params.host or host)
    ok, message = wrapped:dohandshake()
    if ok then return 1 end
    return nil, message == 'wantread' and 'timeout' or message
end

function Connection:settimeout(seconds, mode)
    self.timeout = seconds
    return self.object:settimeout(seconds, mode)
end

local NAMES <const> = {'verify', 'cafile', 'capath', 'certificate', 'key', 'password'}

-- A function that makes connections, as http's `create` is.
-- @api func create = ssl.https.tcp(table params)
function https.tcp(given)
    local params = {mode = 'client'}
    for _, name in ipairs(NAMES) do params[name] = given and given[name] end
    return function()
        local object, message = socket.tcp()
        if not object then return nil, message end
        return setmetatable({object = object, params = params, timeout = https.TIMEOUT}, Connection)
    end
end

-- An URL without a scheme is one of HTTPS.
local function secure(address)
    local parsed = url.parse(address, {scheme = 'https'})
    if not parsed then return nil, 'invalid url' end
    if parsed.scheme ~= 'https' then return nil, ("unknown scheme '%s'"):format(parsed.scheme) end
    return url.build(parsed)
end

-- @api any body, int code, table headers, string status = ssl.https.request(any request, string body = nil)
function https.request(request, body)
    local parts = {}
    local isSimple = type(request) == 'string'
    local whole = {}
    if isSimple then
        whole.url, whole.sink = request, ltn12.sink.table(parts)
        if body then
            whole.source, whole.method = ltn12.source.string(body), 'POST'
            whole.headers = {['content-length'] = #body, ['content-type'] = 'application/x-www-form-urlencoded'}
        end
    else
        for name, value in pairs(request) do whole[name] = value end
    end
    if http.PROXY or whole.proxy then return nil, 'proxy not supported' end
    if whole.create then return nil, 'create function not permitted' end
    local address, message = secure(whole.url)
    if not address then return nil, message end
    whole.url = address
    local ok, code, headers, status = http.request(whole)
    if not ok then return nil, code end
    return isSimple and table.concat(parts) or ok, code, headers, status
end

return https
