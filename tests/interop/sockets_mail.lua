-- Mail and files for the servers of sockets_mail.py.
local smtp = require 'socket.smtp'
local ftp = require 'socket.ftp'
local ltn12 = require 'ltn12'
local mime = require 'mime'
local lfs = require 'lfs'
local checks = require 'sockets_checks'

local is, descriptors = checks.is, checks.descriptors
local function param(name) return sim.getNamedStringParam(name) end
local before = descriptors()

---------------------------------------------------------------- mail

local function send(port, more)
    local mail = {
        from = '<me@example.org>', rcpt = {'<a@example.org>', '<b@example.org>'}, server = '127.0.0.1', port = param(port),
        source = smtp.message{headers = {subject = 'Test', date = 'today'}, body = 'Hello\r\n.dots'},
    }
    for name, value in pairs(more or {}) do mail[name] = value end
    return smtp.send(mail)
end
is(send('smtp', {user = 'user', password = 'p@ss'}), 1, 'mail')
local encoded = ltn12.source.chain(ltn12.source.string('hello'), mime.encode('base64'))
is(send('smtp', {rcpt = '<c@example.org>', source = smtp.message{body = {
    preamble = 'before', epilogue = 'after', {body = 'text'}, {headers = {['content-transfer-encoding'] = 'base64'}, body = encoded},
}}}), 1, 'parts')
is(select(2, send('refusing')), '550 who?', 'refused')
is(select(2, send('vanishing')), 'closed', 'gone at the end')
is(select(2, send('rude')), 'invalid server reply', 'no greeting')
is(select(2, send('closed')), 'connection refused', 'nobody')
is(select(2, send('smtp', {from = '<me>\r\nRCPT TO:<x>', server = '127.0.0.1', port = param('refusing')})), 'line break in an argument', 'two lines')
is(select(2, send('refusing', {source = ltn12.source.error('no text'), rcpt = {}})), 'no text', 'failing source')

---------------------------------------------------------------- files

local FTP = '127.0.0.1:' .. param('ftp')
is(assert(ftp.get('ftp://' .. FTP .. '/file.txt')), 'line 1\r\nline 2\r\n', 'get')
is(ftp.get('ftp://user:p%40ss@' .. FTP .. '/file.txt;type=i'), 'line 1\r\nline 2\r\n', 'get as a user')
is(#ftp.get('ftp://' .. FTP .. '/large;type=i'), 3000000, 'a large file')
is(ftp.put('ftp://user:p%40ss@' .. FTP .. '/put.txt;type=i', 'sent by ftp'), 11, 'put')
local names = {}
is(ftp.get{host = '127.0.0.1', port = param('ftp'), command = 'nlst', sink = (ltn12.sink.table(names))}, 1, 'nlst')
is(table.concat(names):find('large', 1, true) ~= nil, true, 'names')
is(ftp.command{host = '127.0.0.1', port = param('ftp'), user = 'user', password = 'p@ss', command = {'mkd', 'rmd'}, argument = {'new', 'new'},
    check = {'257', '250'}}, 1, 'commands')
is(select(2, ftp.get('ftp://' .. FTP .. '/none')), '550 No such file or directory.', 'no file')
is(select(2, ftp.get('ftp://user:wrong@' .. FTP .. '/')), '530 Authentication failed.', 'wrong password')
is(select(2, ftp.get('ftp://127.0.0.1:' .. param('odd') .. '/x')), '227 nonsense', 'no place for data')
is(select(2, ftp.get('ftp://127.0.0.1:' .. param('gone') .. '/x')), 'closed', 'gone')
is(select(2, ftp.get('ftp://127.0.0.1:' .. param('closed') .. '/x')), 'connection refused', 'nobody')
is(select(2, ftp.get('http://127.0.0.1/x')), "wrong scheme 'http'", 'scheme')
is(select(2, ftp.get('ftp://127.0.0.1/x;type=z')), "invalid type 'z'", 'type')
is(select(2, ftp.get{path = '/x', sink = ltn12.sink.null()}), 'missing hostname', 'host')

is(descriptors(), before, 'descriptors')
