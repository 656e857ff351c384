//! Any bytes as a packed table, in either encoding: a value that can be packed again, or an error.
//!
//! `cargo fuzz run unpack_table`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let code = b"
        sim = require 'sim'
        function unpack(bytes)
            local ok, value = pcall(sim.unpackTable, bytes)
            if ok and type(value) == 'table' and not isbuffer(value) then
                for scheme = 0, 1 do sim.unpackTable(sim.packTable(value, scheme)) end
            end
            return ok
        end";
    let script = sim.add_script(ScriptKind::Customization, "fuzz", code).expect("the script loads");
    let results = sim.call(&script, "unpack", &[Data::Buffer(bytes.to_vec())]).expect("what was unpacked can be packed");
    assert!(matches!(results.first(), Some(Data::Bool(_))));
});
