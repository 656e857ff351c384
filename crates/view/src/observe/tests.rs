//! Changes of a scene, as an observer finds them.

use serde_json::Value;

use super::*;
use crate::blobs::Hash;
use crate::mirror::{Message, Mirror};
use ::scene::Pose;
use ::scene::object::dummy::Dummy;
use script::{SimulationState, Situation};

/// A scene with its observer and mirror.
struct Stage {
    scene: Scene,
    observer: Observer,
    mirror: Mirror,
    seen: u64,
}

impl Stage {
    fn new() -> Self {
        Self {
            scene: Scene::new(),
            observer: Observer::default(),
            mirror: Mirror::default(),
            seen: 0,
        }
    }

    fn dummy(&mut self, alias: &str) -> Handle {
        self.scene
            .add(alias, Kind::Dummy(Dummy::new(0.01)))
            .unwrap()
    }

    fn observe(&mut self) -> Observation {
        self.observe_lines(&[])
    }

    fn observe_lines(&mut self, lines: &[RecentLine]) -> Observation {
        let source = Source {
            now: Situation {
                scene: &self.scene,
                scene_uid: 1,
                state: SimulationState::Running,
                time: 0.0,
                steps: 0,
                errors: 0,
                state_hash: Some(255),
            },
            is_read_only: false,
            mode: "live",
            played: None,
            edits: Value::Null,
            has_debugger: false,
        };
        self.observer.observe(&source, lines)
    }

    /// Observes, and returns the text that a page gets.
    fn update(&mut self) -> Value {
        let seen = self.observe();
        self.mirror.apply(seen);
        let (revision, messages) = self.mirror.update_since(self.seen);
        self.seen = revision;
        let text = messages.into_iter().find_map(|message| match message {
            Message::Text(text) => Some(text),
            Message::Binary(_) => None,
        });
        text.map_or(Value::Null, |text| serde_json::from_str(&text).unwrap())
    }
}

fn handles(objects: &[(i64, ObservedObject)]) -> Vec<i64> {
    objects.iter().map(|(handle, _)| *handle).collect()
}

#[test]
fn what_has_a_hash_shows_it() {
    let mut stage = Stage::new();
    assert_eq!(stage.update()["scene"]["hash"], "00000000000000ff");
}

#[test]
fn only_what_moved_is_placed_again() {
    let mut stage = Stage::new();
    let (base, child, other) = (
        stage.dummy("base"),
        stage.dummy("child"),
        stage.dummy("other"),
    );
    stage.scene.set_parent(child, Some(base), true).unwrap();
    let first = stage.observe();
    assert!(first.is_complete && first.is_another_scene);
    assert_eq!((first.objects.len(), first.poses.len()), (3, 3));
    assert!(stage.observe().poses.is_empty());
    stage
        .scene
        .set_local_pose(base, Pose::translation(1.0, 0.0, 0.0))
        .unwrap();
    let second = stage.observe();
    assert!(second.objects.is_empty() && !second.is_complete);
    let moved = [
        (base.raw(), [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        (child.raw(), [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
    ];
    assert_eq!(second.poses, moved);
    stage
        .scene
        .set_local_pose(other, Pose::translation(0.0, 0.0, 0.0))
        .unwrap();
    assert_eq!(stage.observe().poses.len(), 1);
}

#[test]
fn siblings_learn_their_new_order() {
    let mut stage = Stage::new();
    let (first, second, third) = (stage.dummy("a"), stage.dummy("b"), stage.dummy("c"));
    let places = |update: &Value| -> Vec<(i64, i64)> {
        let objects = update["objects"].as_array().cloned().unwrap_or_default();
        let place = |object: &Value| {
            (
                object["handle"].as_i64().unwrap(),
                object["childOrder"].as_i64().unwrap(),
            )
        };
        objects.iter().map(place).collect()
    };
    assert_eq!(
        places(&stage.update()),
        [(first.raw(), 0), (second.raw(), 1), (third.raw(), 2)]
    );
    stage.scene.set_hierarchy_order(third, 0).unwrap();
    assert_eq!(
        places(&stage.update()),
        [(first.raw(), 1), (second.raw(), 2), (third.raw(), 0)]
    );
    stage.scene.remove(&[third]).unwrap();
    let update = stage.update();
    assert_eq!(
        (&update["removed"], places(&update)),
        (&serde_json::json!([third.raw()]), vec![]),
        "the order is the same"
    );
    let last = stage.dummy("d");
    assert_eq!(places(&stage.update()), [(last.raw(), 2)]);
}

#[test]
fn a_layer_that_is_switched_off_hides_all_on_it() {
    let mut stage = Stage::new();
    stage.dummy("a");
    assert_eq!(stage.update()["objects"][0]["visible"], true);
    stage
        .scene
        .modify_settings(|settings| settings.visibility_layers = ::scene::Layers::empty());
    assert_eq!(stage.update()["objects"][0]["visible"], false);
}

#[test]
fn errors_belong_to_their_script() {
    let mut stage = Stage::new();
    let script = ::scene::object::script_object::ScriptObject::new(
        ::scene::object::script_object::ScriptType::Customization,
        b"error('no')".to_vec(),
        "lua",
        false,
    );
    let script = stage
        .scene
        .add("Script", Kind::Script(Box::new(script)))
        .unwrap();
    stage.update();
    let line = RecentLine {
        time: 1.0,
        level: Some(script::log::verbosity::SCRIPT_ERRORS),
        origin: "/Script".to_owned(),
        script: Some(script.raw()),
        text: "[string \"/Script\"]:3: <b>no</b>".to_owned(),
        located: None,
    };
    let seen = stage.observe_lines(&[line]);
    assert_eq!(handles(&seen.objects), [script.raw()]);
    let object: Value = serde_json::from_str(&seen.objects[0].1.text).unwrap();
    assert_eq!(object["error"]["line"], 3);
    let line: Value = serde_json::from_str(&seen.log[0]).unwrap();
    assert_eq!(
        (&line["level"], &line["line"], &line["handle"]),
        (&"scripterrors".into(), &3.into(), &script.raw().into())
    );
    // What was wrong with another text says nothing about the new one.
    stage
        .scene
        .try_modify(script, ::scene::Field::Script, |object| {
            object.script_mut()?.code = b"print('yes')".to_vec();
            Ok(())
        })
        .expect("the script is there");
    let changed = &stage.update()["objects"][0];
    assert_ne!(changed["version"], object["version"]);
    assert!(changed["error"].is_null());
}

#[test]
fn drawing_objects_are_sent_when_they_change() {
    use ::scene::appearance::colour::Colour;
    use ::scene::drawing::DrawingStyle;
    use ::scene::drawing::options::{DrawingFlags, DrawingKind};
    let mut stage = Stage::new();
    let style = DrawingStyle {
        kind: DrawingKind::Lines,
        flags: DrawingFlags::empty(),
        size: 2.0,
        duplicate_tolerance: 0.0,
        parent: None,
        max_items: 10,
        colour: Colour::new([1.0, 0.0, 0.0]),
    };
    let drawing = stage.scene.add_drawing(style, None).unwrap();
    stage.update();
    assert!(stage.update()["drawings"].is_null());
    stage
        .scene
        .add_drawing_items(drawing, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0])
        .unwrap();
    let shown = stage.update()["drawings"][0].clone();
    assert_eq!(
        (&shown["itemType"], &shown["stride"]),
        (&"line".into(), &6.into())
    );
    assert_eq!(shown["items"].as_array().map(Vec::len), Some(6));
    stage.scene.drawings_mut().remove(drawing).unwrap();
    assert_eq!(
        stage.update()["removedDrawings"],
        serde_json::json!([drawing])
    );
}

#[test]
fn lines_of_old_paths_are_sent_when_they_change() {
    use ::scene::path_object::{ControlPoint, PathAttributes, PathMeasures, PathObject};
    let mut stage = Stage::new();
    let path = PathObject::new(PathAttributes::DEFAULT, PathMeasures::default());
    let handle = stage.scene.add("Path", Kind::Path(path.into())).unwrap();
    assert_eq!(stage.update()["drawings"].as_array().map_or(0, Vec::len), 0);
    let point = |x| ControlPoint {
        pose: Pose::translation(x, 0.0, 0.0),
        before: 0.5,
        after: 0.5,
        count: 1,
        velocity: 1.0,
        on_spot: 0.0,
        flags: 0,
        channels: [0.0; 4],
    };
    stage
        .scene
        .modify_path(handle, |path| {
            path.insert(0, vec![point(0.0), point(1.0)], false)
        })
        .unwrap()
        .unwrap();
    let shown = stage.update()["drawings"][0].clone();
    assert_eq!(
        shown["items"],
        serde_json::json!([0.0, 0.0, 0.0, 1.0, 0.0, 0.0])
    );
    assert_eq!(
        (&shown["itemType"], &shown["parent"]),
        (&"lineStrip".into(), &handle.raw().into())
    );
    stage.scene.remove(&[handle]).unwrap();
    assert_eq!(
        stage.update()["removedDrawings"],
        serde_json::json!([-handle.raw()])
    );
}

#[test]
fn shapes_share_their_meshes() {
    let mut stage = Stage::new();
    stage.scene.add_default_objects().unwrap();
    let shape = stage
        .scene
        .objects()
        .find(|object| object.shape().is_ok())
        .unwrap()
        .handle();
    stage.update();
    let before = stage.mirror.blobs_since(0).count();
    let copies = stage
        .scene
        .copy_objects(&[shape], ::scene::CopyOptions::empty())
        .unwrap();
    let update = stage.update();
    assert!(
        !copies.is_empty()
            && update["objects"]
                .as_array()
                .is_some_and(|objects| !objects.is_empty())
    );
    assert_eq!(stage.mirror.blobs_since(0).count(), before);
    let mesh = update["objects"]
        .as_array()
        .unwrap()
        .iter()
        .find_map(|object| object["meshes"][0]["blob"].as_str());
    let hash = Hash::from_text(mesh.unwrap()).unwrap();
    let blob = stage.mirror.blob(hash).unwrap();
    assert_eq!(&blob.bytes[..4], b"MESH");
    let count = |at: usize| u32::from_le_bytes(blob.bytes[at..at + 4].try_into().unwrap()) as usize;
    let (vertices, triangles, edges, flags) = (count(4), count(8), count(12), count(16));
    let coordinates = if flags == 1 { 24 * triangles } else { 0 };
    assert_eq!(
        blob.bytes.len(),
        20 + 12 * vertices + 48 * triangles + coordinates + 8 * edges
    );
}

#[test]
fn an_observer_that_rereads_describes_what_changed_and_follows_nothing() {
    let mut stage = Stage::new();
    stage.observer = Observer::that_rereads();
    let (first, second) = (stage.dummy("first"), stage.dummy("second"));
    assert_eq!(
        handles(&stage.observe().objects),
        [first.raw(), second.raw()]
    );
    // Nothing changed: no text, but all poses, which may be those of an earlier moment.
    let seen = stage.observe();
    assert!(!seen.is_complete && seen.objects.is_empty());
    assert_eq!(seen.poses.len(), 2);
    stage.scene.remove(&[first]).unwrap();
    let seen = stage.observe();
    assert!(seen.is_complete);
    assert_eq!(handles(&seen.objects), [second.raw()]);
    assert!(!stage.scene.journal().is_followed(::scene::Topic::Added));
    // Errors are those of the moment.
    let line = error_of(second, "3: no");
    stage.observer.set_errors(std::iter::once(&line));
    assert_eq!(handles(&stage.observe().objects), [second.raw()]);
    assert!(stage.observe().objects.is_empty());
    stage.observer.set_errors(std::iter::empty());
    assert_eq!(handles(&stage.observe().objects), [second.raw()]);
}

fn error_of(script: Handle, text: &str) -> RecentLine {
    RecentLine {
        time: 0.0,
        level: Some(script::log::verbosity::SCRIPT_ERRORS),
        origin: "a script".into(),
        script: Some(script.raw()),
        text: text.into(),
        located: None,
    }
}
