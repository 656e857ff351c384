//! Any text as what is soft: the first line as the custom data `softRope`, the second as `softPins`, the rest as `softBody` of a shape, which is simulated for some steps.
//!
//! `cargo fuzz run soft_text`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

const SCRIPT: &[u8] = b"
local sim = require 'sim'
local simSoft = require 'simSoft'
function soft(rope, pins, body)
    local shape = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
    sim.setObjectInt32Param(shape, sim.shapeintparam_static, 0)
    for name, text in pairs{softRope = rope, softPins = pins, softBody = body} do
        if #text > 0 then sim.setStringProperty(shape, 'customData.' .. name, text) end
    end
    sim.startSimulation()
    handle = shape
end
function read() pcall(simSoft.getPoints, handle) pcall(simSoft.getTriangles, handle) pcall(simSoft.getVolume, handle) end
";

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let script = sim.add_script(ScriptKind::Customization, "fuzz", SCRIPT).expect("the harness compiles");
    let mut lines = bytes.splitn(3, |byte| *byte == b'\n');
    let texts: Vec<Data> = (0..3).map(|_| Data::Text(lines.next().unwrap_or_default().to_vec())).collect();
    if texts.iter().any(|text| matches!(text, Data::Text(text) if text.len() > 4000)) {
        return;
    }
    // Names of properties and texts that are no UTF-8 may be refused.
    if sim.call(&script, "soft", &texts).is_err() {
        return;
    }
    for _ in 0..4 {
        sim.iterate();
    }
    sim.call(&script, "read", &[]).expect("errors are caught");
});
