--[[
Mail by SMTP.

    send{from=, rcpt=, source=, user=, password=, server=, port=, domain=, step=, create=}
                            1, or nil and the reason; rcpt is an address or a list of them
    message{headers=, body=}    a source for a message; body is a string, a source, or a list of messages with preamble and epilogue
    open(server, port, create)  the commands one by one
    TIMEOUT, SERVER, PORT, DOMAIN, ZONE
]]

local socket = require('socket')
local ltn12 = require('ltn12')
local mime = require('mime')
local tp = require('socket.tp')
local canonic = require('socket.headers').canonic

local smtp = {TIMEOUT = 60, SERVER = 'localhost', PORT = 25, DOMAIN = os.getenv('SERVER_NAME') or 'localhost', ZONE = '-0000'}

---------------------------------------------------------------- session

local Session = {}
Session.__index = Session

-- A line of the session must not end a command early.
local function oneLine(self, text)
    text = tostring(text)
    if text:find('[\r\n]') then self.try(nil, 'line break in an argument') end
    return text
end

function Session:greet(domain)
    self.try(self.tp:check('2..'))
    self.try(self.tp:command('EHLO', oneLine(self, domain or smtp.DOMAIN)))
    return socket.skip(1, self.try(self.tp:check('2..')))
end

function Session:mail(from)
    self.try(self.tp:command('MAIL', 'FROM:' .. oneLine(self, from)))
    return self.try(self.tp:check('2..'))
end

function Session:rcpt(to)
    self.try(self.tp:command('RCPT', 'TO:' .. oneLine(self, to)))
    return self.try(self.tp:check('2..'))
end

function Session:data(source, step)
    self.try(self.tp:command('DATA'))
    self.try(self.tp:check('3..'))
    self.try(self.tp:source(source, step))
    self.try(self.tp:send('\r\n.\r\n'))
    return self.try(self.tp:check('2..'))
end

function Session:quit()
    self.try(self.tp:command('QUIT'))
    return self.try(self.tp:check('2..'))
end

function Session:close() return self.tp:close() end

function Session:login(user, password)
    self.try(self.tp:command('AUTH', 'LOGIN'))
    self.try(self.tp:check('3..'))
    self.try(self.tp:send(mime.b64(user) .. '\r\n'))
    self.try(self.tp:check('3..'))
    self.try(self.tp:send(mime.b64(password) .. '\r\n'))
    return self.try(self.tp:check('2..'))
end

function Session:plain(user, password)
    self.try(self.tp:command('AUTH', 'PLAIN ' .. mime.b64('\0' .. user .. '\0' .. password)))
    return self.try(self.tp:check('2..'))
end

-- By the way the server offers.
function Session:auth(user, password, extensions)
    if not user or not password then return 1 end
    local offered = tostring(extensions)
    if offered:find('AUTH[^\n]+LOGIN') then return self:login(user, password) end
    if offered:find('AUTH[^\n]+PLAIN') then return self:plain(user, password) end
    self.try(nil, 'authentication not supported')
end

function Session:send(mail)
    self:mail(mail.from)
    local recipients = type(mail.rcpt) == 'table' and mail.rcpt or {mail.rcpt}
    for _, recipient in ipairs(recipients) do self:rcpt(recipient) end
    return self:data(ltn12.source.chain(mail.source, mime.stuff()), mail.step)
end

-- @api table session = socket.smtp.open(string server, any port = 25, func create = nil)
function smtp.open(server, port, create)
    local connection = socket.try(tp.connect(server or smtp.SERVER, port or smtp.PORT, smtp.TIMEOUT, create))
    local session = setmetatable({tp = connection}, Session)
    session.try = socket.newtry(function() session:close() end)
    return session
end

smtp.send = socket.protect(function(mail)
    local session = smtp.open(mail.server, mail.port, mail.create)
    local extensions = session:greet(mail.domain)
    session:auth(mail.user, mail.password, extensions)
    session:send(mail)
    session:quit()
    return session:close()
end)

---------------------------------------------------------------- messages

local boundaries = 0

local function newBoundary()
    boundaries = boundaries + 1
    return ('%s%05d==%05u'):format(os.date('%d%m%Y%H%M%S'), math.random(0, 99999), boundaries)
end

local function headerLines(headers)
    local lines = {}
    for name, value in pairs(headers) do lines[#lines + 1] = ('%s: %s'):format(canonic[name] or name, value) end
    table.sort(lines)
    return table.concat(lines, '\r\n') .. '\r\n\r\n'
end

local yieldMessage

local function yieldSource(source)
    while true do
        local chunk, failure = source()
        if failure then coroutine.yield(nil, failure) end
        if not chunk then return end
        coroutine.yield(chunk)
    end
end

local function yieldParts(message, headers)
    local boundary = newBoundary()
    local kind = headers['content-type'] or 'multipart/mixed'
    headers['content-type'] = ('%s; boundary="%s"'):format(kind, boundary)
    coroutine.yield(headerLines(headers))
    if message.body.preamble then coroutine.yield(message.body.preamble .. '\r\n') end
    for _, part in ipairs(message.body) do
        coroutine.yield('\r\n--' .. boundary .. '\r\n')
        yieldMessage(part)
    end
    coroutine.yield('\r\n--' .. boundary .. '--\r\n\r\n')
    if message.body.epilogue then coroutine.yield(message.body.epilogue .. '\r\n') end
end

function yieldMessage(message)
    local headers = {}
    for name, value in pairs(message.headers or {}) do headers[name:lower()] = value end
    if type(message.body) == 'table' then return yieldParts(message, headers) end
    headers['content-type'] = headers['content-type'] or 'text/plain; charset="iso-8859-1"'
    coroutine.yield(headerLines(headers))
    if type(message.body) == 'function' then return yieldSource(message.body) end
    coroutine.yield(message.body)
end

-- A source for the whole message; date, mailer and version are added.
-- @api func source = socket.smtp.message(table message)
function smtp.message(message)
    local headers = {}
    for name, value in pairs(message.headers or {}) do headers[name:lower()] = value end
    headers.date = headers.date or os.date('!%a, %d %b %Y %H:%M:%S ') .. (message.zone or smtp.ZONE)
    headers['x-mailer'] = headers['x-mailer'] or socket._VERSION
    headers['mime-version'] = '1.0'
    local whole = coroutine.create(function() yieldMessage({headers = headers, body = message.body}) end)
    return function()
        if coroutine.status(whole) == 'dead' then return nil end
        local ok, chunk, failure = coroutine.resume(whole)
        if ok then return chunk, failure end
        return nil, chunk
    end
end

return smtp
