//! Any bytes as a message of the WebSocket remote API: a request or none, and a request has a reply with its id.
//!
//! `cargo fuzz run ws_request`
#![no_main]

use libfuzzer_sys::fuzz_target;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, Simulator};

const SCRIPT: &[u8] = b"
local codecs = require 'remote.ws_codecs'
function answer(bytes)
    local request, codec = codecs.decode(bytes)
    if not request then return end
    local reply = codecs.reply(codec, request.id, true, {n = 3, request.func, nil, request.args})
    local answer = assert(codecs.decode(reply), 'a reply is no message')
    local lost = request.id ~= nil and answer.id == nil
    assert(not lost or answer.error == 'the id cannot be encoded', 'the id is lost')
end
";

fuzz_target!(|bytes: &[u8]| {
    let mut sim = Simulator::new(Options::default());
    let script = sim.add_script(ScriptKind::Customization, "fuzz", SCRIPT).expect("the harness compiles");
    sim.call(&script, "answer", &[Data::Text(bytes.to_vec())]).expect("every request is answered");
});
