//! Any text as a window of simUI: it is opened or refused, pages get JSON, and any input is done or refused. The first line of the bytes is the input.
//!
//! `cargo fuzz run window`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

const SCRIPT: &[u8] = b"
local simUI = require 'simUI'
function open(text)
    local ok, window = pcall(simUI.create, text)
    return ok and window or ''
end
function close(window) simUI.destroy(window) end
";

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let script = sim.add_script(ScriptKind::Customization, "fuzz", SCRIPT).expect("the harness compiles");
    let line = bytes.iter().position(|byte| *byte == b'\n').unwrap_or(0);
    let (input, text) = bytes.split_at(line);
    let opened = sim.call(&script, "open", &[Data::Text(text.to_vec())]).expect("errors are caught");
    let [Data::Text(window)] = opened.as_slice() else { panic!("open returns a text") };
    if window.is_empty() {
        return;
    }
    let snapshot = sim.ui_snapshot();
    assert_eq!(snapshot["windows"].as_array().map(Vec::len), Some(1));
    if let Ok(mut input) = serde_json::from_slice::<serde_json::Value>(input) {
        if let Some(fields) = input.as_object_mut() {
            fields.insert("window".to_owned(), String::from_utf8_lossy(window).into_owned().into());
        }
        let _ = sim.ui_input(&input);
        sim.iterate();
    }
    let revision = sim.ui_snapshot()["revision"].as_u64().expect("it is a number");
    assert!(sim.ui_changes(revision).is_none());
    sim.call(&script, "close", &[Data::Text(window.clone())]).expect("the window exists");
    assert!(sim.ui_changes(revision).is_some());
});
