//! The usual main script does the same with a Lua state and without.

use crate::{Options, ScriptKind, ScriptRef, Simulator};
use scene::Data;

/// The usual text, which is known by its bytes, and the same with more bytes.
const IN_LUA: &[u8] = b"require('defaultMainScript') -- in Lua";

/// Notes which callbacks are called, in all kinds of scripts.
const NOTES: &str = r"
sim = require 'sim'
local function note(what)
    local notes = sim.getStringProperty(sim.handle_scene, 'customData.notes', {noError = true}) or ''
    sim.setStringProperty(sim.handle_scene, 'customData.notes', notes .. NAME .. ' ' .. what .. '\n')
end
for _, name in ipairs{'init', 'actuation', 'sensing', 'cleanup', 'suspend', 'suspended', 'resume', 'msg', 'beforeMainScript', 'dyn'} do
    _G['sysCall_' .. name] = function() note(name) end
end
";

/// A body that falls, a joint on its way and a sensor.
const SCENE: &str = r"
sim = require 'sim'
box = sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1})
sim.setBoolProperty(box, 'dynamic', true)
sim.setObjectPosition(box, {0, 0, 2})
joint = sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0)
sensor = sim.createProximitySensor(sim.proximitysensor_ray_subtype, 16, 0, {3, 3, 2, 2, 1, 1, 0, 0}, {0, 0.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})
function aim(position) sim.setJointTargetPosition(joint, position) end
function notes() return sim.getStringProperty(sim.handle_scene, 'customData.notes') end
function do_in_main(text) return sim.executeScriptString(text, sim.getScript(sim.scripttype_main)) end
";

fn simulator(is_in_lua: bool) -> (Simulator, ScriptRef) {
    let mut simulator = Simulator::new(Options::default());
    if is_in_lua {
        add(&mut simulator, ScriptKind::Main, IN_LUA);
    }
    let scene = add(&mut simulator, ScriptKind::Customization, SCENE.as_bytes());
    for (kind, name) in [
        (ScriptKind::Simulation, "first"),
        (ScriptKind::Simulation, "second"),
        (ScriptKind::Customization, "customization"),
        (ScriptKind::AddOn, "add-on"),
    ] {
        let code = NOTES.replace("NAME", &format!("'{name}'"));
        add(&mut simulator, kind, code.as_bytes());
    }
    (simulator, scene)
}

fn add(simulator: &mut Simulator, kind: ScriptKind, code: &[u8]) -> ScriptRef {
    let added = simulator.add_script(kind, "script", code);
    added.expect("the script loads")
}

fn call(simulator: &mut Simulator, script: &ScriptRef, name: &str, args: &[Data]) -> Vec<Data> {
    let results = simulator.call(script, name, args);
    results.expect("the function works")
}

/// The hashes of a run, with a pause in it, and what scripts noted.
fn course(is_in_lua: bool, while_running: impl Fn(&mut Simulator, &ScriptRef)) -> (Vec<u64>, Data) {
    let (mut simulator, scene) = simulator(is_in_lua);
    let mut hashes = Vec::new();
    for _ in 0..2 {
        simulator.start();
        for step in 0..12 {
            if step == 5 {
                while_running(&mut simulator, &scene);
            }
            if step == 8 {
                simulator.pause();
                for _ in 0..4 {
                    simulator.iterate();
                }
                simulator.start();
            }
            simulator.iterate();
            hashes.push(simulator.state_hash());
        }
        simulator.stop();
        hashes.push(simulator.state_hash());
    }
    assert_eq!(simulator.errors(), 0);
    let mut notes = call(&mut simulator, &scene, "notes", &[]);
    (hashes, notes.remove(0))
}

fn both(while_running: impl Fn(&mut Simulator, &ScriptRef)) {
    let without = course(false, &while_running);
    let Data::Text(notes) = &without.1 else {
        panic!("no text: {:?}", without.1)
    };
    assert!(notes.windows(9).any(|word| word == b"suspended"));
    assert_eq!(without, course(true, &while_running));
}

#[test]
fn callbacks_come_in_the_same_order_with_the_same_state() {
    both(|_, _| {});
}

#[test]
fn joints_move_the_same_way() {
    both(|simulator, scene| {
        call(simulator, scene, "aim", &[Data::Float(0.7)]);
    });
}

#[test]
fn code_in_the_main_script_finds_what_it_would_find() {
    both(|simulator, scene| {
        let text = "(function() local n = 0 for _ in pairs(package.loaded) do n = n + 1 end return type(sysCall_joint) .. n .. sim_script_name_index end)()";
        let found = call(simulator, scene, "do_in_main", &[Data::text(text)]);
        call(simulator, scene, "aim", &[Data::Float(found.len() as f64)]);
        assert!(
            matches!(&found[1], Data::Text(text) if text.starts_with(b"function")),
            "{found:?}"
        );
    });
}

#[test]
fn code_in_the_main_script_replaces_its_callbacks() {
    for is_in_lua in [false, true] {
        let (mut simulator, scene) = simulator(is_in_lua);
        simulator.step(3);
        let text = "(function() function sysCall_actuation() count = (count or 0) + 1 end end)()";
        call(&mut simulator, &scene, "do_in_main", &[Data::text(text)]);
        simulator.step(4);
        let count = call(&mut simulator, &scene, "do_in_main", &[Data::text("count")]);
        assert_eq!(count, [Data::Int(0), Data::Int(4)]);
    }
}
