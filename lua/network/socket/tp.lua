--[[
Protocols of commands and numbered replies, such as SMTP and FTP.

    connect(host, port, timeout, create)    an object with command(cmd, arg), check(ok), send, receive, sink, source, skip, close
]]

local socket = require('socket')
local ltn12 = require('ltn12')

local tp = {TIMEOUT = 60}

local MAX_LINES <const> = 10000

-- A reply: its code, and its lines as they came. Lines of a longer one carry a hyphen until the last.
local function reply(c)
    local line, message = c:receive()
    if not line then return nil, message end
    local code, separator = line:match('^(%d%d%d)(.?)')
    if not code then return nil, 'invalid server reply' end
    local lines = {line}
    while separator == '-' do
        line, message = c:receive()
        if not line then return nil, message end
        lines[#lines + 1] = line
        if #lines > MAX_LINES then return nil, 'invalid server reply' end
        if line:sub(1, 4) == code .. ' ' then break end
    end
    return code, table.concat(lines, '\n')
end

local Connection = {}
Connection.__index = Connection

-- Waits for a reply. `ok` is a pattern for its code, a list of patterns, or a function of code and text.
function Connection:check(ok)
    local code, text = reply(self.c)
    if not code then return nil, text end
    if type(ok) == 'function' then return ok(tonumber(code), text) end
    for _, pattern in ipairs(type(ok) == 'table' and ok or {ok}) do
        if code:find(pattern) then return tonumber(code), text end
    end
    return nil, text
end

function Connection:command(command, argument)
    command = command:upper()
    return self.c:send(argument and ('%s %s\r\n'):format(command, argument) or command .. '\r\n')
end

function Connection:sink(chunk) return self.c:send(chunk) end
function Connection:send(data) return self.c:send(data) end
function Connection:receive(pattern) return self.c:receive(pattern) end
function Connection:getfd() return self.c:getfd() end
function Connection:dirty() return self.c:dirty() end
function Connection:getcontrol() return self.c end

-- Sends everything the source gives.
function Connection:source(source, step)
    local sent, message = ltn12.pump.all(source, socket.sink('keep-open', self.c), step or ltn12.pump.step)
    return sent, message
end

function Connection:close()
    self.c:close()
    return 1
end

-- @api table connection, string error = socket.tp.connect(string host, any port, float timeout = 60, func create = nil)
function tp.connect(host, port, timeout, create)
    local c, message = (create or socket.tcp)()
    if not c then return nil, message end
    c:settimeout(timeout or tp.TIMEOUT)
    local ok
    ok, message = c:connect(host, port)
    if ok then return setmetatable({c = c}, Connection) end
    c:close()
    return nil, message
end

return tp
