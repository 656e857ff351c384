//! Any bytes as a packed table: a value or an error.
//!
//! `cargo fuzz run unpack_table`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let code = b"sim = require 'sim' function unpack(bytes) return pcall(sim.unpackTable, bytes) end";
    let script = sim.add_script(ScriptKind::Customization, "fuzz", code).expect("the script loads");
    let results = sim.call(&script, "unpack", &[Data::Buffer(bytes.to_vec())]).expect("pcall returns");
    assert!(matches!(results.first(), Some(Data::Bool(_))));
});
