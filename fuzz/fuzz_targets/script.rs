//! Any text as a thread of a script: pre-emption bounds what it runs, and nothing it does may end the process.
//!
//! `cargo fuzz run script -- -timeout=10`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::{Options, ScriptKind, Simulator};

/// Runs the global `text`, without what ends the program or reaches out of it.
const HARNESS: &str = "
sim = require 'sim'
os, io, quit, exit, quitSimulator, sim.quitSimulator, sim.wait = nil
function sysCall_thread()
    local f = load(text)
    if f then f() end
end
";

fuzz_target!(|text: &[u8]| {
    let options = Options { instructions_per_ms: 1000, ..Options::default() };
    let mut sim = Simulator::new(options);
    let literal: String = text.iter().map(|byte| format!("\\{byte:03}")).collect();
    let code = format!("text = '{literal}'{HARNESS}");
    if sim.add_script(ScriptKind::Customization, "fuzz", code.as_bytes()).is_ok() {
        sim.step(5);
    }
});
