//! Any bytes as a program of a script that may run no native code: bytecode is refused whichever way it comes, also that of what was
//! compiled a moment ago.
//!
//! `cargo fuzz run bytecode`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, Permissions, ScriptKind, Simulator};

const SCRIPT: &[u8] = b"
local function check(text, f, message)
    if text:sub(1, 1) ~= '\\27' then return end
    assert(f == nil, 'bytecode was loaded')
    assert(message:find('binary chunk') or message:find('bytecode is not allowed'), message)
end

-- As a string, and from a reader in pieces.
local function try(text)
    for _, mode in ipairs {'t', 'b', 'bt', 'x'} do check(text, load(text, 'text', mode)) end
    local f, message = load(text)
    check(text, f, message)
    for _, size in ipairs {1, 3, 64} do
        local at = 1 - size
        check(text, load(function()
            at = at + size
            return text:sub(at, at + size - 1)
        end))
    end
    return f
end

function load_all(text)
    local f = try(text)
    if f then try(string.dump(f)) end
    try('\\27' .. text)
    try('\\27Lua' .. text)
end
";

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options { permissions: Permissions::strict(), ..Options::default() });
    let script = sim.add_script(ScriptKind::Customization, "fuzz", SCRIPT).expect("the harness compiles");
    sim.call(&script, "load_all", &[Data::Text(bytes.to_vec())]).expect("bytecode is refused");
});
