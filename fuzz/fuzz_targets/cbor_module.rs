//! Any bytes to the decoder of `org.conman.cbor`, natively and with conversions: the same value or the same error, and what was
//! decoded can be encoded again.
//!
//! `cargo fuzz run cbor_module`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

const SCRIPT: &[u8] = b"
local cbor = require 'org.conman.cbor'
local simCBOR = require 'simCBOR'
local conversions = {UINT = function(v) return v end}
function decode(bytes)
    local value, pos, ctype = cbor.pdecode(bytes)
    local _, pos2, ctype2 = cbor.pdecode(bytes, 1, conversions)
    assert(ctype == ctype2, ctype .. ' and ' .. ctype2)
    assert(ctype == '__error' or pos == pos2, 'ends differ')
    if ctype ~= '__error' then cbor.pencode(value) end
    pcall(simCBOR.decode, bytes)
end
";

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let script = sim.add_script(ScriptKind::Customization, "fuzz", SCRIPT).expect("the harness compiles");
    sim.call(&script, "decode", &[Data::Text(bytes.to_vec())]).expect("both decoders agree");
});
