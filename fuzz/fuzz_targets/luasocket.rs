//! Any bytes as what a server answers, as an address and as mail: LuaSocket's modules return an error or a result, whichever pieces the bytes
//! come in.
//!
//! `cargo fuzz run luasocket`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

const SCRIPT: &[u8] = b"
local http, url, mime = require 'socket.http', require 'socket.url', require 'mime'
local ftp, smtp, ltn12 = require 'socket.ftp', require 'socket.smtp', require 'ltn12'

-- A connection over which `bytes` come.
local function connection(bytes)
    local at, c = 1, {}
    function c:settimeout() return 1 end
    function c:connect() return 1 end
    function c:close() return 1 end
    function c:getpeername() return '127.0.0.1', 21 end
    function c:getsockname() return '127.0.0.1', 2000 end
    function c:send(data, from, to) return to or #data end
    function c:dirty() return at <= #bytes end
    function c:getfd() return -1 end
    function c:receive(pattern)
        local stop, found
        if pattern == '*a' or pattern == 'a' then
            stop, found = #bytes, true
        elseif type(pattern) == 'number' then
            stop, found = at + pattern - 1, at + pattern - 1 <= #bytes
        else
            stop = bytes:find('\\n', at, true)
            found, stop = stop ~= nil, stop or #bytes
        end
        local part = bytes:sub(at, stop)
        at = math.min(stop, #bytes) + 1
        if not found then return nil, 'closed', part end
        return (pattern == nil or pattern == '*l') and part:gsub('\\r?\\n$', '') or part
    end
    return c
end

local function addresses(bytes)
    local parsed = url.parse(bytes)
    if parsed then url.parse(url.build(parsed)) end
    url.build_path(url.parse_path(bytes))
    url.absolute('http://host/a/b', bytes)
    url.unescape(url.escape(bytes))
end

local function filters(bytes)
    for _, name in ipairs {'base64', 'quoted-printable'} do
        for _, size in ipairs {1, 7, 4096} do
            local sink, parts = ltn12.sink.table()
            local at = 1 - size
            local source = function()
                at = at + size
                return at <= #bytes and bytes:sub(at, at + size - 1) or nil
            end
            ltn12.pump.all(ltn12.source.chain(source, mime.decode(name)), sink)
            local encoded = ltn12.filter.chain(mime.encode(name), mime.wrap(name, 20))
            ltn12.pump.all(ltn12.source.chain(ltn12.source.string(bytes), encoded), sink)
        end
    end
    -- Of nothing, mime makes nil.
    if bytes ~= '' then assert(mime.unb64((mime.b64(bytes))) == bytes, 'base64 is not its own inverse') end
end

local function servers(bytes)
    local create = function() return connection(bytes) end
    for _, method in ipairs {'GET', 'HEAD'} do
        http.request {url = 'http://host/', method = method, create = create, sink = ltn12.sink.null()}
    end
    http.request {url = 'http://host/', proxy = 'http://proxy:80', create = create, sink = ltn12.sink.null()}
    ftp.get {host = 'host', path = 'file', create = create, sink = ltn12.sink.null()}
    smtp.send {from = '<a@b>', rcpt = '<c@d>', server = 'host', create = create, source = ltn12.source.string(bytes)}
end

function read_all(bytes)
    addresses(bytes)
    filters(bytes)
    servers(bytes)
end
";

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let script = sim.add_script(ScriptKind::Customization, "fuzz", SCRIPT).expect("the harness compiles");
    sim.call(&script, "read_all", &[Data::Text(bytes.to_vec())]).expect("nothing is raised");
});
