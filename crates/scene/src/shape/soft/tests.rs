//! Ropes as custom data and as meshes.

use super::*;
use crate::Kind;

fn rope() -> Rope {
    Rope {
        radius: 0.01,
        line_density: 0.1,
        stretch: 1e4,
        bend: 0.01,
        twist: 0.02,
        damping: 0.001,
        drag: 0.0,
        strength: f64::INFINITY,
        length: 0.0,
        straight: false,
        touches_itself: true,
        points: vec![[0.0; 3], [0.1, 0.0, 0.0], [0.2, 0.0, 0.1]],
    }
}

#[test]
fn a_rope_is_what_its_text_says() {
    assert_eq!(Rope::parse(&rope().to_string()), Some(rope()));
    assert_eq!(Rope::parse("radius=0.01 points=0,0,0;1,0,0"), None);
    assert_eq!(
        Rope::parse(&rope().to_string().replace("0.1,0,0", "0.1,0")),
        None
    );
    assert_eq!(
        Rope::parse(&rope().to_string().replace("bend=0.01", "bend=-1")),
        None
    );
}

#[test]
fn pins_refer_to_objects_that_are_there() {
    let mut scene = Scene::new();
    let shape = Shape::of_rope(&rope(), Appearance::new([0.5; 3])).unwrap();
    let handle = scene.add("rope", Kind::Shape(Box::new(shape))).unwrap();
    scene.set_rope(handle, &rope()).unwrap();
    let dummy = crate::object::dummy::Dummy::new(0.01);
    let holder = scene.add("holder", Kind::Dummy(dummy)).unwrap();
    let pins = [
        Pin {
            point: 0,
            holder: None,
            place: [1.0, 2.0, 3.0],
            clamped: true,
        },
        Pin {
            point: 2,
            holder: Some(holder),
            place: [0.0, 0.5, 0.0],
            clamped: false,
        },
    ];
    scene.set_pins(handle, &pins).unwrap();
    assert_eq!(scene.object(handle).unwrap().pins(), pins);
    scene.remove(&[holder]).unwrap();
    assert_eq!(scene.object(handle).unwrap().pins(), pins[..1]);
}

#[test]
fn the_mesh_follows_and_returns() {
    let mut scene = Scene::new();
    let shape = Shape::of_rope(&rope(), Appearance::new([0.5; 3])).unwrap();
    let mesh = Rc::clone(&shape.parts[0].mesh);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (24, 44));
    let handle = scene.add("rope", Kind::Shape(Box::new(shape))).unwrap();
    scene.set_rope(handle, &rope()).unwrap();
    let mut form = scene.rope_form(handle).unwrap();
    form.points[2] = [0.2, 0.0, 0.5];
    form.broken[0] = true;
    scene.report_rope(handle, Some(form.clone())).unwrap();
    assert_eq!(scene.rope_form(handle).unwrap(), form);
    let part = &scene.object(handle).unwrap().shape().unwrap().parts[0];
    assert_eq!(part.mesh.vertices.len(), 16);
    assert_eq!(part.mesh.triangles.len(), 28);
    scene.report_rope(handle, None).unwrap();
    let part = &scene.object(handle).unwrap().shape().unwrap().parts[0];
    assert_eq!(part.mesh.vertices, mesh.vertices);
}
