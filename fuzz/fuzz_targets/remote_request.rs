//! Any bytes as a request of a remote client, by a handler without sockets: at most one answer, which is CBOR.
//!
//! `cargo fuzz run remote_request -- -timeout=10`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

const HARNESS: &[u8] = include_bytes!("../../tests/support/remote_requests.lua");

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let script = sim.add_script(ScriptKind::Customization, "fuzz", HARNESS).expect("the harness compiles");
    // The second one meets what the first one left.
    for _ in 0..2 {
        sim.call(&script, "ask", &[Data::Text(bytes.to_vec())]).expect("one answer, well-formed");
    }
});
