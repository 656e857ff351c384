//! Changes of pages in a simulator, with undo and redo.

mod files;
mod objects;

use serde_json::{Value, json};

use super::Editor;
use crate::perform::perform;
use crate::request::Action;
use scene::Data;
use simulator::{Options, Simulator};

// Snapshots need the memory of a simulator in one place.
#[global_allocator]
static ALLOCATOR: heap::Allocator = heap::Allocator;

struct Desk {
    sim: Simulator,
    editor: Editor,
}

impl Desk {
    fn new() -> Self {
        Self {
            sim: Simulator::new(Options::default()),
            editor: Editor::default(),
        }
    }

    fn ask(&mut self, action: &Action) -> Result<Value, String> {
        perform(&mut self.sim, action, &mut Vec::new(), &mut self.editor)
    }

    fn edit(&mut self, edit: &str, arguments: Value) -> Result<Value, String> {
        self.ask(&Action::Edit {
            edit: edit.into(),
            arguments,
            gesture: None,
        })
    }

    /// The handle of a new object.
    fn add(&mut self, kind: &str, more: &Value) -> i64 {
        let mut arguments = more.clone();
        arguments["kind"] = kind.into();
        let done = self.edit("add", arguments).unwrap();
        done["selection"][0].as_i64().unwrap()
    }

    /// What a line of Lua prints.
    fn lua(&mut self, code: &str) -> String {
        self.sim.keep_recent_lines();
        let mut lines = Vec::new();
        let action = Action::Run(code.into());
        let text = perform(&mut self.sim, &action, &mut lines, &mut self.editor).unwrap();
        text.as_str().unwrap().to_owned()
    }

    fn aliases(&self) -> Vec<String> {
        let scene = self.sim.scene();
        scene
            .objects()
            .map(|object| object.alias().to_owned())
            .collect()
    }

    fn position(&self, handle: i64) -> [f64; 3] {
        let scene = self.sim.scene();
        let pose = scene
            .world_pose(scene::Handle::from_raw(handle).unwrap())
            .unwrap();
        pose.translation.vector.into()
    }
}

#[test]
fn every_kind_of_object_is_added_and_undone() {
    let kinds = "cuboid sphere cylinder cone capsule plane revoluteJoint prismaticJoint sphericalJoint dummy forceSensor raySensor \
                 coneSensor visionSensor camera omniLight spotLight directionalLight simulationScript customizationScript";
    let mut desk = Desk::new();
    for (number, kind) in kinds.split_whitespace().enumerate() {
        desk.add(kind, &json!({ "position": [1, 2, 0] }));
        assert_eq!(desk.aliases().len(), number + 1, "{kind}");
    }
    let all = desk.aliases();
    for number in (0..all.len()).rev() {
        desk.ask(&Action::Undo { others: true }).unwrap();
        assert_eq!(desk.aliases(), all[..number]);
    }
    assert_eq!(
        desk.ask(&Action::Undo { others: true }),
        Err("there is nothing to undo".into())
    );
    for number in 1..=all.len() {
        desk.ask(&Action::Redo { others: true }).unwrap();
        assert_eq!(desk.aliases(), all[..number]);
    }
    assert_eq!(
        desk.ask(&Action::Redo { others: true }),
        Err("there is nothing to redo".into())
    );
}

#[test]
fn shapes_stand_where_they_are_put_and_children_are_at_their_parents() {
    let mut desk = Desk::new();
    let cuboid = desk.add("cuboid", &json!({ "position": [1, 2, 0.5] }));
    assert_eq!(desk.position(cuboid), [1.0, 2.0, 0.55]);
    let joint = desk.add(
        "revoluteJoint",
        &json!({ "parent": cuboid, "position": [9, 9, 9] }),
    );
    assert_eq!(desk.position(joint), [1.0, 2.0, 0.55]);
    assert_eq!(
        desk.lua(&format!("sim.getObjectParent({joint}) == {cuboid}")),
        "true"
    );
    let body =
        format!("sim.getBoolProperty({cuboid}, 'dynamic'), sim.getFloatProperty({cuboid}, 'mass')");
    assert_eq!(desk.lua(&body), "true, 1.");
}

#[test]
fn moves_of_one_gesture_are_one_step_of_undo() {
    let mut desk = Desk::new();
    let cuboid = desk.add("cuboid", &json!({}));
    let mut drag = |gesture, x: f64| {
        desk.ask(&Action::Edit {
            edit: "move".into(),
            arguments: json!({ "handles": [cuboid], "poses": [[x, 0, 1, 0, 0, 0, 1]] }),
            gesture: Some(gesture),
        })
        .unwrap()
    };
    drag(1, 1.0);
    drag(1, 2.0);
    assert_eq!(drag(2, 3.0)["label"], "Move Cuboid");
    assert_eq!(desk.position(cuboid), [3.0, 0.0, 1.0]);
    desk.ask(&Action::Undo { others: true }).unwrap();
    assert_eq!(desk.position(cuboid), [2.0, 0.0, 1.0]);
    desk.ask(&Action::Undo { others: true }).unwrap();
    assert_eq!(desk.position(cuboid), [0.0, 0.0, 0.05]);
    desk.ask(&Action::Redo { others: true }).unwrap();
    assert_eq!(desk.position(cuboid), [2.0, 0.0, 1.0]);
}

#[test]
fn a_drag_goes_along_the_axes_of_its_frame() {
    let mut desk = Desk::new();
    let base = desk.add("cuboid", &json!({}));
    let arm = desk.add("cylinder", &json!({ "parent": base }));
    let drag = |desk: &mut Desk, gesture: u64, more: Value| {
        let mut arguments = more;
        arguments["gesture"] = gesture.into();
        desk.ask(&Action::Edit {
            edit: "drag".into(),
            arguments,
            gesture: Some(gesture),
        })
        .unwrap()
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    drag(
        &mut desk,
        1,
        json!({ "handles": [base, arm], "active": base, "frame": "world", "turn": [0, 0, 1, quarter] }),
    );
    drag(
        &mut desk,
        2,
        json!({ "handles": [arm], "active": arm, "frame": "own", "by": [0.1, 0, 0] }),
    );
    drag(
        &mut desk,
        2,
        json!({ "handles": [arm], "active": arm, "frame": "own", "by": [0.3, 0, 0] }),
    );
    let near =
        |at: [f64; 3], wanted: [f64; 3]| at.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(
        near(desk.position(arm), [0.0, 0.3, 0.05]),
        "{:?}",
        desk.position(arm)
    );
    drag(
        &mut desk,
        3,
        json!({ "handles": [arm], "active": arm, "frame": "parent", "by": [0, 0.2, 0] }),
    );
    assert!(
        near(desk.position(arm), [-0.2, 0.3, 0.05]),
        "{:?}",
        desk.position(arm)
    );
    drag(
        &mut desk,
        4,
        json!({ "handles": [base, arm], "active": base, "frame": "world", "turn": [0, 0, 1, quarter] }),
    );
    assert!(
        near(desk.position(arm), [-0.3, -0.2, 0.05]),
        "{:?}",
        desk.position(arm)
    );
}

#[test]
fn properties_and_code_are_undone_as_well() {
    let mut desk = Desk::new();
    let cuboid = desk.add("cuboid", &json!({}));
    desk.ask(&Action::Set {
        handle: cuboid,
        name: "mass".into(),
        value: json!(5.0),
        gesture: None,
    })
    .unwrap();
    assert_eq!(
        desk.editor.describe(&desk.sim)["undo"],
        "Set mass of Cuboid"
    );
    desk.lua(&format!("x = 7 sim.setObjectAlias({cuboid}, 'box')"));
    assert_eq!(desk.aliases(), ["box"]);
    desk.ask(&Action::Undo { others: true }).unwrap();
    assert_eq!(
        (desk.aliases(), desk.lua("x == nil")),
        (vec!["Cuboid".into()], "true".into())
    );
    desk.ask(&Action::Undo { others: true }).unwrap();
    desk.ask(&Action::Undo { others: true }).unwrap();
    assert_eq!(
        desk.lua(&format!("sim.getFloatProperty({cuboid}, 'mass')")),
        "1."
    );
}

#[test]
fn properties_of_one_gesture_are_one_step_of_undo() {
    let mut desk = Desk::new();
    let cuboid = desk.add("cuboid", &json!({}));
    let mut set = |gesture, mass: f64| {
        desk.ask(&Action::Set {
            handle: cuboid,
            name: "mass".into(),
            value: mass.into(),
            gesture,
        })
        .unwrap();
    };
    for (gesture, mass) in [
        (Some(7), 2.0),
        (Some(7), 3.0),
        (Some(8), 4.0),
        (None, 5.0),
        (None, 6.0),
    ] {
        set(gesture, mass);
    }
    let mut masses = Vec::new();
    for _ in 0..4 {
        desk.ask(&Action::Undo { others: true }).unwrap();
        let Ok(Data::Float(mass)) = desk.sim.property_value(cuboid, "mass") else {
            panic!("it has a mass");
        };
        masses.push(mass.round());
    }
    assert_eq!(masses, [5.0, 4.0, 3.0, 1.0]);
}

#[test]
fn what_another_page_has_done_is_not_undone_without_asking() {
    let mut desk = Desk::new();
    let (mine, theirs) = (Some(1), Some(2));
    desk.editor.set_author(mine);
    let cuboid = desk.add("cuboid", &json!({}));
    desk.editor.set_author(theirs);
    desk.edit("rename", json!({ "handle": cuboid, "alias": "theirs" }))
        .unwrap();
    desk.editor.set_author(mine);
    assert_eq!(desk.editor.describe(&desk.sim)["undoBy"], json!(theirs));
    let (own, all) = (
        |desk: &mut Desk| desk.ask(&Action::Undo { others: false }),
        |desk: &mut Desk| desk.ask(&Action::Undo { others: true }),
    );
    let refused = json!({ "label": "Rename Cuboid to theirs", "isAnothers": true });
    assert_eq!(
        (own(&mut desk), desk.aliases()),
        (Ok(refused), vec!["theirs".to_owned()])
    );
    assert_eq!(all(&mut desk).unwrap()["isAnothers"], Value::Null);
    assert_eq!(desk.aliases(), ["Cuboid"]);
    let redone = desk.ask(&Action::Redo { others: false }).unwrap();
    assert_eq!(redone["isAnothers"], true);
    assert_eq!(own(&mut desk).unwrap(), json!({ "label": "Add Cuboid" }));
    assert!(desk.aliases().is_empty());
}

#[test]
fn what_fails_leaves_nothing_behind() {
    let mut desk = Desk::new();
    let cuboid = desk.add("cuboid", &json!({}));
    let moved =
        json!({ "handles": [cuboid, 99], "poses": [[1, 0, 0, 0, 0, 0, 1], [1, 0, 0, 0, 0, 0, 1]] });
    assert!(desk.edit("move", moved).is_err());
    assert_eq!(desk.position(cuboid), [0.0, 0.0, 0.05]);
    for (edit, arguments) in [
        ("explode", json!({})),
        ("x(os.exit())", json!({})),
        ("add", json!({ "kind": "elephant" })),
        ("rename", json!({})),
        ("remove", json!({ "handles": "all" })),
        ("remove", Value::Null),
        ("parent", json!({ "handles": [cuboid], "parent": 77 })),
    ] {
        let outcome = desk.edit(edit, arguments);
        assert!(
            outcome.as_ref().is_err_and(|reason| !reason.is_empty()),
            "{edit}: {outcome:?}"
        );
    }
    assert_eq!(desk.aliases(), ["Cuboid"]);
    assert_eq!(desk.editor.describe(&desk.sim)["undo"], "Add Cuboid");
}

#[test]
fn changes_while_the_simulation_runs_are_not_undone() {
    let mut desk = Desk::new();
    let cuboid = desk.add("cuboid", &json!({}));
    desk.sim.step(1);
    desk.edit(
        "move",
        json!({ "handles": [cuboid], "poses": [[1, 0, 3, 0, 0, 0, 1]] }),
    )
    .unwrap();
    assert_eq!(desk.position(cuboid)[0], 1.0);
    assert!(
        desk.ask(&Action::Undo { others: true })
            .unwrap_err()
            .contains("stop the simulation first")
    );
    desk.sim.stop();
    assert_eq!(
        (
            desk.position(cuboid)[0],
            desk.editor.describe(&desk.sim)["undo"].as_str()
        ),
        (0.0, Some("Add Cuboid"))
    );
}

#[test]
fn a_pull_moves_a_body_to_its_target() {
    let mut desk = Desk::new();
    let ball = desk.add("sphere", &json!({ "position": [0, 0, 1] }));
    let pull = |desk: &mut Desk, handle| {
        desk.ask(&Action::Pull {
            handle,
            point: [0.0; 3],
            target: Some([0.5, 0.0, 1.2]),
        })
    };
    assert!(pull(&mut desk, ball).unwrap_err().contains("start it"));
    let mut force = Value::Null;
    for _ in 0..100 {
        desk.sim.step(1);
        force = pull(&mut desk, ball).unwrap();
    }
    let mass = 1000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3);
    let lift = force["force"][2].as_f64().unwrap();
    assert!(
        (lift - mass * 9.81).abs() < 0.01,
        "it carries the weight: {lift}"
    );
    let at = desk.position(ball);
    // The spring of 8 rad/s hangs through by g / 64.
    assert!(
        (at[0] - 0.5).abs() < 1e-3 && (at[2] - (1.2 - 9.81 / 64.0)).abs() < 2e-3,
        "{at:?}"
    );
    let camera = desk.add("camera", &json!({}));
    assert!(pull(&mut desk, camera).unwrap_err().contains("static"));
}
