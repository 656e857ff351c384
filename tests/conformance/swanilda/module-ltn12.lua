-- topic: modules
-- as: sandbox
-- passes: 0
-- note: ltn12, and the errors as results of socket
local ltn12 = require 'ltn12'
local source, sink, filter, pump = ltn12.source, ltn12.sink, ltn12.filter, ltn12.pump
local function collect(from)
    local out = {}
    local ok, message = pump.all(from, (sink.table(out)))
    return ok, message, table.concat(out, '|')
end
print(collect(source.empty()))
print(collect(source.string('hello')))
print(#table.concat(select(2, sink.table())), #source.string(('x'):rep(5000))(), collect(source.string(nil)))
print(collect(source.table({'a', 'b', '', 'c'})))
print(collect(source.cat(source.table({'a', 'b'}), source.empty(), source.string('c'))))
print(collect(source.cat(source.table({'a'}), source.error('broken'), source.string('c'))))
print(collect(source.file(nil, 'no file')), collect(source.error('why')))
local again = source.rewind(source.table({'a', 'b', 'c'}))
print(again(), again('x'), again('y'), again(), again(), again(), again(), again())
local fancy = source.simplify(function() return 'first', source.table({'second', 'third'}) end)
print(collect(fancy))
local upper = function(chunk) return chunk and chunk:upper() end
local held
-- Gives each chunk with the next, the last one at the end.
local delay = function(chunk)
    if chunk == '' then return '' end
    local out = held or (chunk and '')
    held = chunk
    return out
end
print(collect(source.chain(source.table({'a', 'b', 'c'}), upper, delay)))
print(collect(source.chain(source.table({'a', 'b'}), filter.chain(delay, upper))))
local out = {}
local chained = sink.chain(upper, delay, (sink.table(out)))
print(chained('a'), chained(''), chained('b'), chained(nil), table.concat(out, '|'))
print(select(2, pcall(source.chain(source.table({'a'}), function() return nil end))):match(': (.*)'))
print(filter.cycle(function(n, chunk, step) return chunk and chunk .. n, n + step end, 1, 2)('x'))
print(sink.null()('x'), sink.error('full')('x'))
print(pump.all(source.table({'a', 'b'}), sink.error('full')), pump.step(source.empty(), sink.null()))
local name = os.tmpname()
print(pump.all(source.table({'some', ' text'}), sink.file(io.open(name, 'w'))), collect(source.file(io.open(name, 'r'))))
os.remove(name)
local simple = sink.simplify(function(chunk) return 1, sink.null() end)
print(simple('x'), simple('y'))

local socket = require 'socket'
local closed = 0
local try = socket.newtry(function() closed = closed + 1 end)
local guarded = socket.protect(function(...) return try(...) end)
print(guarded(1, 2, 3), closed)
print(guarded(nil, 'reason', 'lost'))
print(guarded(false, {1} and 'no'), closed)
print(pcall(socket.protect(function() error({code = 5}, 0) end)))
print(pcall(socket.protect(function() error('plain', 0) end)))
print(socket.protect(function() return socket.protect(function() return try(nil, 'inner') end)() end)())
local thread = coroutine.wrap(socket.protect(function() coroutine.yield('yielded') try(nil, 'later') end))
print(thread(), thread())
print(socket.skip(2, 'a', 'b', 'c', 'd'), pcall(socket.sink, 'nonsense'))
