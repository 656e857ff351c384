//! Files that pages drop, and where the scene is saved.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde_json::json;

use super::Desk;
use crate::request::Action;

#[test]
fn files_of_pages_come_into_the_scene() {
    let urdf = r#"<robot name="cart"><link name="base"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
        <collision><geometry><mesh filename="meshes/box.stl"/></geometry></collision></link></robot>"#;
    let triangle = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let stl = format!("solid a\n{triangle}endsolid a\n");
    let files = BTreeMap::from([
        ("cart.urdf".to_owned(), urdf.as_bytes().to_vec()),
        ("meshes/box.stl".to_owned(), stl.into_bytes()),
        ("bad.ttt".to_owned(), b"VREP?".to_vec()),
        (
            "made.lua".to_owned(),
            b"sim = require 'sim'\nfunction sysCall_init() sim.createDummy(0.1) end".to_vec(),
        ),
    ]);
    let files = Arc::new(files);
    let mut desk = Desk::new();
    let load = |desk: &mut Desk, main: &str| {
        desk.ask(&Action::Load {
            main: main.into(),
            files: Arc::clone(&files),
            position: json!([2, 3, 0]),
        })
    };
    let done = load(&mut desk, "cart.urdf").unwrap();
    let robot = done["selection"][0].as_i64().unwrap();
    assert_eq!(desk.position(robot)[..2], [2.0, 3.0]);
    let many = desk.aliases().len();
    load(&mut desk, "meshes/box.stl").unwrap();
    assert_eq!(desk.aliases().len(), many + 1);
    assert!(load(&mut desk, "bad.ttt").is_err() && load(&mut desk, "none.stl").is_err());
    desk.ask(&Action::Undo { others: true }).unwrap();
    desk.ask(&Action::Undo { others: true }).unwrap();
    assert_eq!(desk.aliases().len(), 0);
    load(&mut desk, "made.lua").unwrap();
    desk.sim.iterate();
    assert!(
        desk.aliases().contains(&"dummy".to_owned()),
        "{:?}",
        desk.aliases()
    );
}

#[test]
fn nothing_is_overwritten_without_a_word() {
    let folder = tempfile::tempdir().unwrap();
    let mut desk = Desk::new();
    desk.add("cuboid", &json!({}));
    let ball = desk.add("sphere", &json!({}));
    let save = |desk: &mut Desk, name: &str, model, may_overwrite| {
        let path = folder.path().join(name).to_string_lossy().into_owned();
        let action = Action::Save {
            path,
            model,
            may_overwrite,
        };
        desk.ask(&action)
    };
    assert!(
        desk.ask(&Action::Changes).unwrap()["text"]
            .as_str()
            .unwrap()
            .contains("Cuboid")
    );
    for name in ["a.ttt", "a.simscene.xml", "a.glb", "folder"] {
        assert_eq!(
            save(&mut desk, name, None, false).unwrap()["exists"],
            false,
            "{name}"
        );
        assert!(folder.path().join(name).exists(), "{name}");
        let before = std::fs::metadata(folder.path().join(name))
            .unwrap()
            .modified()
            .unwrap();
        assert_eq!(
            save(&mut desk, name, None, false).unwrap()["exists"],
            true,
            "{name}"
        );
        assert_eq!(
            std::fs::metadata(folder.path().join(name))
                .unwrap()
                .modified()
                .unwrap(),
            before
        );
    }
    assert_eq!(
        save(&mut desk, "a.ttt", None, true).unwrap()["exists"],
        false
    );
    let refused = save(&mut desk, "ball.ttm", Some(ball), false).unwrap_err();
    assert!(refused.contains("not tagged as model base"), "{refused}");
    desk.edit("model", json!({ "handle": ball, "on": true }))
        .unwrap();
    assert_eq!(
        save(&mut desk, "ball.ttm", Some(ball), false).unwrap()["exists"],
        false
    );
    desk.ask(&Action::Undo { others: true }).unwrap();
    assert_eq!(desk.ask(&Action::Changes).unwrap()["text"], "");
    assert_eq!(
        save(&mut desk, "a.ttt", None, true).unwrap()["exists"],
        false
    );
    assert_eq!(desk.editor.describe(&desk.sim)["changes"], 0);
    assert!(save(&mut desk, "none/b.ttt", None, false).is_err());
    assert!(
        desk.ask(&Action::Save {
            path: " ".into(),
            model: None,
            may_overwrite: false
        })
        .is_err()
    );
}
