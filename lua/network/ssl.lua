--[[
TLS on connected TCP objects, with the names of LuaSec.

    wrap(object, params)        an object that takes over the connection; call dohandshake() next
    newcontext(params)          params that wrap takes, checked
    params: mode ('client' or 'server'), verify ('peer', which is the default, or 'none'), cafile, certificate, key, host

Objects: dohandshake, send, receive, close, settimeout, gettimeout, dirty, getfd, getpeername, getsockname, getstats, setstats, sni, info,
want, shutdown. A client must say the name of the server, by sni(name) or params.host, unless it verifies nothing.
]]

local _, native = ...
require('socket.core') -- defines the classes

local ssl = {_VERSION = '1.3.2'}

local SSL <const> = 3
local settings = setmetatable({}, {__mode = 'k'}) -- by object, until the handshake

local methods = {}
for _, name in ipairs({'close', 'getfd', 'dirty', 'settimeout', 'gettimeout', 'getsockname', 'getpeername', 'setfd'}) do
    methods[name] = native['any:' .. name]
end
for _, name in ipairs({'send', 'receive', 'getstats', 'setstats', 'shutdown'}) do methods[name] = native['stream:' .. name] end

local wanted = setmetatable({}, {__mode = 'k'})

function methods:dohandshake()
    local ok, message = native.dohandshake(self, settings[self] or {})
    wanted[self] = message == 'timeout' and 'read' or nil
    if message == 'timeout' then return false, 'wantread' end
    if ok then return true end
    return false, message
end

function methods:sni(name) settings[self].host = name end

-- What a handshake that timed out waits for.
function methods:want() return wanted[self] or 'nothing' end

function methods:info(field)
    local version, cipher = native.info(self)
    local all = {protocol = version, cipher = cipher}
    if field then return all[field] end
    return all
end

native.define(SSL, {
    __index = methods, __gc = native.collect, __name = 'SSL connection',
    __tostring = function(object) return ('%s: %p'):format(native.class_name(object), object) end,
})

-- LuaSec's `verify` is a word or a list of words.
local function verification(given)
    local words = type(given) == 'table' and given or {given}
    for _, word in ipairs(words) do
        if word ~= 'none' then return 'peer' end
    end
    return #words > 0 and 'none' or 'peer'
end

-- @api table context, string error = ssl.newcontext(table params)
function ssl.newcontext(params)
    if type(params) ~= 'table' then return nil, 'invalid parameters' end
    if params.mode ~= nil and params.mode ~= 'client' and params.mode ~= 'server' then return nil, 'invalid mode (' .. tostring(params.mode) .. ')' end
    if params.capath then return nil, 'not implemented in Swanilda: capath' end
    if params.password then return nil, 'not implemented in Swanilda: keys with a password' end
    local context = {verify = verification(params.verify)}
    for _, name in ipairs({'mode', 'host', 'cafile', 'certificate', 'key'}) do context[name] = params[name] end
    return context
end

-- @api table object, string error = ssl.wrap(table object, table params)
function ssl.wrap(object, params)
    local context, message = ssl.newcontext(params)
    if not context then return nil, message end
    local wrapped
    wrapped, message = native.wrap(object)
    if not wrapped then return nil, message end
    settings[wrapped] = context
    return wrapped
end

return ssl
