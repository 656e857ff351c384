//! The tree, groups, sizes and places of objects.

use serde_json::json;

use super::Desk;

#[test]
fn the_tree_is_changed() {
    let mut desk = Desk::new();
    let (base, arm) = (
        desk.add("cuboid", &json!({})),
        desk.add("cylinder", &json!({ "position": [1, 0, 0] })),
    );
    desk.edit("parent", json!({ "handles": [arm], "parent": base }))
        .unwrap();
    assert_eq!(
        (
            desk.lua(&format!("sim.getObjectParent({arm}) == {base}")),
            desk.position(arm)
        ),
        ("true".into(), [1.0, 0.0, 0.05])
    );
    assert!(
        desk.edit("parent", json!({ "handles": [base], "parent": arm }))
            .is_err(),
        "a circle"
    );
    desk.edit("rename", json!({ "handle": base, "alias": "base" }))
        .unwrap();
    let copy = desk
        .edit("duplicate", json!({ "handles": [base, arm] }))
        .unwrap();
    assert_eq!(
        copy["selection"].as_array().unwrap().len(),
        1,
        "the arm is below the base"
    );
    assert_eq!(desk.aliases().len(), 4);
    assert!(
        desk.position(copy["selection"][0].as_i64().unwrap())[0] > 0.1,
        "it is seen"
    );
    desk.edit("remove", json!({ "handles": [base] })).unwrap();
    assert_eq!(desk.aliases().len(), 2);
}

#[test]
fn shapes_are_grouped_and_taken_apart() {
    let mut desk = Desk::new();
    let shapes = [
        desk.add("cuboid", &json!({})),
        desk.add("sphere", &json!({ "position": [1, 0, 0] })),
    ];
    let group = desk.edit("group", json!({ "handles": shapes })).unwrap()["selection"][0].clone();
    assert_eq!(desk.aliases().len(), 1);
    let parts = desk.edit("ungroup", json!({ "handle": group })).unwrap();
    assert_eq!(parts["selection"].as_array().unwrap().len(), 2);
}

#[test]
fn what_is_dropped_rests_on_what_is_below() {
    let mut desk = Desk::new();
    desk.add("cuboid", &json!({ "position": [0, 0, 0] }));
    let ball = desk.add("sphere", &json!({ "position": [0, 0, 2] }));
    let aside = desk.add("cylinder", &json!({ "position": [3, 0, 2] }));
    desk.edit("drop", json!({ "handles": [ball, aside] }))
        .unwrap();
    let height = |handle| desk.position(handle)[2];
    assert!((height(ball) - 0.15).abs() < 1e-4, "{}", height(ball));
    assert!((height(aside) - 0.05).abs() < 1e-4, "{}", height(aside));
    let camera = desk.add("camera", &json!({}));
    let refused = desk
        .edit("drop", json!({ "handles": [camera] }))
        .unwrap_err();
    assert_eq!(refused, "Camera has no shape that could rest on something");
}

#[test]
fn shapes_get_the_size_that_is_written() {
    let mut desk = Desk::new();
    let wheel = desk.add("cylinder", &json!({}));
    desk.edit(
        "resize",
        json!({ "handle": wheel, "size": [0.2, 0.2, 0.05] }),
    )
    .unwrap();
    assert_eq!(
        desk.lua(&format!("(sim.getShapeBB({wheel}))")),
        "{0.2, 0.2, 0.05}"
    );
    let plane = desk.add("plane", &json!({}));
    desk.edit("resize", json!({ "handle": plane, "size": [5, 5, 0] }))
        .unwrap();
    assert_eq!(desk.lua(&format!("sim.getShapeBB({plane})[1]")), "5.");
    assert!(
        desk.edit("resize", json!({ "handle": wheel, "size": [0, 0.1, 0.1] }))
            .is_err()
    );
}

#[test]
fn sensors_see_what_is_before_them() {
    for kind in ["raySensor", "coneSensor"] {
        let mut desk = Desk::new();
        let sensor = desk.add(kind, &json!({}));
        desk.add("cuboid", &json!({ "position": [0, 0, 0.3] }));
        let distance = desk.lua(&format!(
            "({sensor} and select(2, sim.checkProximitySensor({sensor}, sim.handle_all)))"
        ));
        assert_eq!(distance, "0.3", "{kind}");
    }
}
