//! The journal from both sides: what Rust changes, scripts learn; what scripts change, a reader in Rust learns.

use crate::{ScriptKind, ScriptRef, Simulator};
use scene::{Change, Cursor, Data, Field, Handle, Kind, Pose, Topics, Unread};
use script::Options;

/// Counts events about objects by name, and remembers the last position of the object `watched`.
const LISTENER: &[u8] = b"
local sim, cbor = require 'sim', require 'org.conman.cbor'
local counts, place = {}, ''
function sysCall_init() end
function sysCall_event(batch)
    for _, event in ipairs(cbor.decode(tostring(batch))) do
        counts[event.event] = (counts[event.event] or 0) + 1
        local pose = event.data.pose
        if event.event == 'objectChanged' and pose then place = event.handle .. ' at ' .. pose[1] end
    end
end
function counted(name) return counts[name] or 0 end
function placed() return place end
";

fn simulator() -> (Simulator, Handle) {
    let mut sim = Simulator::new(Options::default());
    let dummy = Kind::Dummy(scene::object::dummy::Dummy::new(0.01));
    let dummy = sim
        .scene_mut()
        .add("watched", dummy)
        .expect("there is room");
    (sim, dummy)
}

fn listener(sim: &mut Simulator) -> ScriptRef {
    let script = sim
        .add_script(ScriptKind::Customization, "listener", LISTENER)
        .expect("the script loads");
    sim.iterate();
    script
}

fn counted(sim: &mut Simulator, listener: &ScriptRef, event: &str) -> i64 {
    match sim
        .call(listener, "counted", &[Data::text(event)])
        .expect("the function is there")[..]
    {
        [Data::Int(count)] => count,
        ref other => panic!("no count: {other:?}"),
    }
}

fn move_to(sim: &mut Simulator, dummy: Handle, x: f64) {
    sim.scene_mut()
        .set_local_pose(dummy, Pose::translation(x, 0.0, 0.0))
        .expect("the dummy exists");
}

fn read(sim: &Simulator, cursor: &mut Cursor) -> Vec<Change> {
    match sim.scene().journal().read(cursor) {
        Unread::Everything => panic!("nothing was lost"),
        Unread::Changes(changes) => changes.cloned().collect(),
    }
}

#[test]
fn a_reader_in_rust_learns_what_scripts_and_rust_change() {
    let (mut sim, dummy) = simulator();
    let mut cursor = sim
        .scene()
        .journal()
        .follow(Topics::TREE.with_fields(&[Field::Pose]));
    assert!(matches!(
        sim.scene().journal().read(&mut cursor),
        Unread::Everything
    ));
    move_to(&mut sim, dummy, 1.0);
    let code = b"sim = require 'sim' sim.setObjectPosition(sim.getObject('/watched'), {2, 0, 0}) sim.createDummy(0.01)";
    sim.add_script(ScriptKind::Sandbox, "changes", code)
        .expect("the script runs");
    let changes = read(&sim, &mut cursor);
    let moved = Change::Modified(dummy, Field::Pose);
    assert!(
        matches!(&changes[..], [first, second, Change::Added(_)] if *first == moved && *second == moved),
        "{changes:?}"
    );
}

#[test]
fn scripts_learn_what_rust_changes() {
    let (mut sim, dummy) = simulator();
    let listener = listener(&mut sim);
    move_to(&mut sim, dummy, 3.0);
    sim.iterate();
    let place = sim
        .call(&listener, "placed", &[])
        .expect("the function is there");
    assert_eq!(place, [Data::text(&format!("{} at 3.0", dummy.raw()))]);
}

#[test]
fn scripts_get_a_new_genesis_after_an_overflow() {
    let (mut sim, dummy) = simulator();
    let listener = listener(&mut sim);
    let world = counted(&mut sim, &listener, "objectAdded");
    assert!(world > 2, "the world was told at first: {world}");
    (0..300_000).for_each(|x| move_to(&mut sim, dummy, f64::from(x)));
    sim.iterate();
    assert_eq!(counted(&mut sim, &listener, "objectAdded"), 2 * world);
    move_to(&mut sim, dummy, 0.5);
    sim.iterate();
    let place = sim
        .call(&listener, "placed", &[])
        .expect("the function is there");
    assert_eq!(
        place,
        [Data::text(&format!("{} at 0.5", dummy.raw()))],
        "events go on"
    );
    assert_eq!(counted(&mut sim, &listener, "objectAdded"), 2 * world);
}
