//! What scripts of CoppeliaSim up to 4.1 count on, and programs that load its library.

use swanilda::scene::object::dummy::Dummy;
use swanilda::scene::{Field, Kind};
use swanilda::{Options, ScriptKind, Simulator};

/// Runs a customization script, and says whether it failed.
fn fails(sim: &mut Simulator, code: &str) -> bool {
    let code = format!("function sysCall_init() {code} end");
    let added = sim.add_script(ScriptKind::Customization, "test", code.as_bytes());
    added.is_err() || sim.errors() > 0
}

#[test]
fn planning_sets_itself_up_where_it_is_asked_for() {
    for sets_up_plans in [true, false] {
        let mut sim = Simulator::new(Options {
            sets_up_plans,
            ..Options::default()
        });
        let failed = fails(
            &mut sim,
            "local point, task = sim.createDummy(0.01), simOMPL.createTask('task')
            local plane = simOMPL.StateSpaceType.position2d
            simOMPL.setStateSpace(task, {simOMPL.createStateSpace('s', plane, point, {-1, -1}, {1, 1}, 1)})
            simOMPL.setStartState(task, {-0.5, 0})
            for i = 1, 2 do
                simOMPL.setGoalState(task, {0.5, 0.25 * i})
                local found, path = simOMPL.compute(task, 1)
                assert(found and path[#path] == 0.25 * i)
            end",
        );
        assert_eq!(failed, !sets_up_plans);
    }
}

#[test]
fn without_a_key_an_extension_string_is_whole() {
    let mut sim = Simulator::new(Options::default());
    let mut scene = sim.scene_mut();
    let kind = Kind::Dummy(Dummy::new(0.01));
    let dummy = scene.add("told", kind).expect("there is room");
    scene
        .modify(dummy, Field::Other, |object| {
            object.extension_string = "povray {focalBlur {true}}".into();
        })
        .expect("it exists");
    drop(scene);
    let failed = fails(
        &mut sim,
        "local told, whole = sim.getObject('/told'), 'povray {focalBlur {true}}'
        assert(sim.getExtensionString(told, -1, '') == whole and sim.getExtensionString(told, -1) == whole)
        assert(sim.getExtensionString(told, -1, nil) == whole)
        assert(sim.getExtensionString(told, -1, 'focalBlur@povray') == 'true')
        assert(sim.getExtensionString(told, -1, 'other@povray') == nil)",
    );
    assert!(!failed);
}
