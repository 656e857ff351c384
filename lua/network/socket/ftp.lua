--[[
Files by FTP, in passive mode.

    get(url), get{host=, path=, sink=, user=, password=, port=, type=, command=, argument=, step=, create=}
    put(url, content), put{..., source=}
    command{host=, command=, argument=, check=, user=, password=, port=, create=}    commands and codes may be lists
    open(server, port, create)      the commands one by one
    TIMEOUT, USER, PASSWORD, PORT

Failures are results: nil and the reason.
]]

local socket = require('socket')
local url = require('socket.url')
local ltn12 = require('ltn12')
local tp = require('socket.tp')

local ftp = {TIMEOUT = 60, PORT = 21, USER = 'ftp', PASSWORD = 'anonymous@anonymous.org'}

---------------------------------------------------------------- session

local Session = {}
Session.__index = Session

-- A command, and the code of its reply.
local function ask(self, expected, command, argument)
    if tostring(argument):find('[\r\n]') then self.try(nil, 'line break in an argument') end
    self.try(self.tp:command(command, argument))
    return self.try(self.tp:check(expected))
end

function Session:greet()
    local code = self.try(self.tp:check({'1..', '2..'}))
    if code // 100 == 1 then self.try(self.tp:check('2..')) end
    return 1
end

function Session:login(user, password)
    local code = ask(self, {'2..', '331'}, 'user', user or ftp.USER)
    if code == 331 then ask(self, '2..', 'pass', password or ftp.PASSWORD) end
    return 1
end

-- Where the server waits for data: the host of the control connection, whatever the server says, so that it cannot send us elsewhere.
function Session:pasv()
    self.try(self.tp:command('pasv'))
    local _, text = self.try(self.tp:check('2..'))
    local high, low = text:match('%d+%D%d+%D%d+%D%d+%D(%d+)%D(%d+)')
    self.try(high, text)
    return self:passive(tonumber(high) * 256 + tonumber(low))
end

function Session:epsv()
    self.try(self.tp:command('epsv'))
    local _, text = self.try(self.tp:check('229'))
    local port = text:match('%((.)%1%1(%d+)%1%)') and text:match('(%d+).%)')
    self.try(port, 'invalid epsv response')
    return self:passive(tonumber(port))
end

function Session:passive(port)
    local host = self.try(self.tp.c:getpeername())
    self.passiveTo = {host = host, port = port}
    return host, port
end

function Session:type(kind) return ask(self, '200', 'type', kind) end
function Session:cwd(folder) return ask(self, '250', 'cwd', folder) end

function Session:quit()
    ask(self, '2..', 'quit')
    return 1
end

function Session:close()
    if self.data then self.data:close() end
    if self.server then self.server:close() end
    return self.tp:close()
end

-- Connects to where the data are.
local function openData(self)
    self.data = self.try(socket.tcp())
    self.try(self.data:settimeout(ftp.TIMEOUT))
    self.try(self.data:connect(self.passiveTo.host, self.passiveTo.port))
end

function Session:receive(request)
    self.try(self.passiveTo, 'need passive before receive')
    openData(self)
    local code = ask(self, {'1..', '2..'}, request.command or 'retr', request.argument)
    local source = socket.source('until-closed', self.data)
    self.try(ltn12.pump.all(source, request.sink, request.step or ltn12.pump.step))
    self.data:close()
    if code // 100 == 1 then self.try(self.tp:check('2..')) end
    return 1
end

function Session:send(request)
    self.try(self.passiveTo, 'need passive before send')
    openData(self)
    ask(self, {'1..', '2..'}, request.command or 'stor', request.argument)
    local sink = socket.sink('close-when-done', self.data)
    self.try(ltn12.pump.all(request.source, sink, request.step or ltn12.pump.step))
    self.try(self.tp:check('2..'))
    local _, sent = self.data:getstats()
    return sent
end

-- @api table session = socket.ftp.open(string server, any port = 21, func create = nil)
function ftp.open(server, port, create)
    local connection = socket.try(tp.connect(server, port or ftp.PORT, ftp.TIMEOUT, create))
    local session = setmetatable({tp = connection}, Session)
    session.try = socket.newtry(function() session:close() end)
    return session
end

---------------------------------------------------------------- requests

local function parse(address)
    local request = socket.try(url.parse(address))
    socket.try(request.scheme == 'ftp', "wrong scheme '" .. tostring(request.scheme) .. "'")
    socket.try(request.host, 'missing hostname')
    if request.params then
        request.type = request.params:match('^type=(.)$')
        socket.try(request.type == 'a' or request.type == 'i', "invalid type '" .. tostring(request.type) .. "'")
    end
    return request
end

local function begin(request)
    socket.try(request.host, 'missing hostname')
    local session = ftp.open(request.host, request.port, request.create)
    session:greet()
    local user = request.user and url.unescape(request.user)
    session:login(user, request.password and url.unescape(request.password))
    return session
end

local function finish(session)
    session:quit()
    session:close()
end

-- The argument of the command: given, or the path of the URL.
local function withArgument(request)
    local whole = {}
    for name, value in pairs(request) do whole[name] = value end
    if not whole.argument and whole.path then whole.argument = url.unescape((whole.path:gsub('^/', ''))) end
    if whole.argument == '' then whole.argument = nil end
    return whole
end

-- A connection for data; of addresses longer than 32 bits only the newer command knows.
local function passive(session)
    local _, _, family = session.tp.c:getpeername()
    return family == 'inet6' and session:epsv() or session:pasv()
end

local function get(request)
    request = withArgument(request)
    local session = begin(request)
    if request.type then session:type(request.type) end
    passive(session)
    session:receive(request)
    finish(session)
    return 1
end

local function put(request)
    request = withArgument(request)
    local session = begin(request)
    if request.type then session:type(request.type) end
    passive(session)
    local sent = session:send(request)
    finish(session)
    return sent
end

ftp.get = socket.protect(function(request)
    if type(request) ~= 'string' then return get(request) end
    local parts = {}
    request = parse(request)
    request.sink = ltn12.sink.table(parts)
    get(request)
    return table.concat(parts)
end)

ftp.put = socket.protect(function(request, content)
    if type(request) == 'string' then
        request = parse(request)
        request.source = ltn12.source.string(content)
    end
    return put(request)
end)

ftp.command = socket.protect(function(request)
    socket.try(request.command, 'missing command')
    local commands = type(request.command) == 'table' and request.command or {request.command}
    local session = begin(request)
    for i, command in ipairs(commands) do
        local function of(field) return type(field) == 'table' and field[i] or type(field) ~= 'table' and field or nil end
        session.try(session.tp:command(command, of(request.argument)))
        local expected = of(request.check)
        if expected then session.try(session.tp:check(expected)) end
    end
    finish(session)
    return 1
end)

return ftp
