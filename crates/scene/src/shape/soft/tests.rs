//! Ropes, cloths and volumes as custom data and as meshes.

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
    let shape = Shape::of_soft(&Soft::Rope(rope()), Appearance::new([0.5; 3])).unwrap();
    let handle = scene.add("rope", Kind::Shape(Box::new(shape))).unwrap();
    scene.set_soft(handle, &Soft::Rope(rope())).unwrap();
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
    let shape = Shape::of_soft(&Soft::Rope(rope()), Appearance::new([0.5; 3])).unwrap();
    let mesh = Rc::clone(&shape.parts[0].mesh);
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (24, 44));
    let handle = scene.add("rope", Kind::Shape(Box::new(shape))).unwrap();
    scene.set_soft(handle, &Soft::Rope(rope())).unwrap();
    let mut form = scene.soft_form(handle).unwrap();
    form.points[2] = [0.2, 0.0, 0.5];
    form.broken[0] = true;
    scene
        .report_soft_form(handle, &Soft::Rope(rope()), Some(form.clone()))
        .unwrap();
    assert_eq!(scene.soft_form(handle).unwrap(), form);
    let part = &scene.object(handle).unwrap().shape().unwrap().parts[0];
    assert_eq!(part.mesh.vertices.len(), 16);
    assert_eq!(part.mesh.triangles.len(), 28);
    scene
        .report_soft_form(handle, &Soft::Rope(rope()), None)
        .unwrap();
    let part = &scene.object(handle).unwrap().shape().unwrap().parts[0];
    assert_eq!(part.mesh.vertices, mesh.vertices);
}

/// Two triangles in a square.
fn cloth() -> Body {
    Body {
        radius: 0.001,
        density: 0.2,
        stretch: 1000.0,
        bend: 1e-5,
        poisson: 0.3,
        strength: f64::INFINITY,
        flat: true,
        points: vec![[0.0; 3], [0.1, 0.0, 0.0], [0.1, 0.1, 0.0], [0.0, 0.1, 0.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Body::default()
    }
}

#[test]
fn a_body_is_what_its_text_says() {
    let volume = Body {
        young: 1e5,
        pressure: Some(-20.5),
        points: vec![[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]],
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        tetrahedra: vec![[0, 1, 2, 3]],
        touches_itself: true,
        ..cloth()
    };
    for body in [cloth(), volume] {
        let text = body.to_string();
        assert_eq!(Body::parse(&text), Some(body));
    }
    let refused = [
        ("triangles=0,1,2", "triangles=0,1,4"),
        ("triangles=0,1,2", "triangles=0,1"),
        ("triangles=0,1,2", "triangles=0,1,-2"),
        ("points=0,0,0", "points=0,0,nan"),
        ("poisson=0.3", "poisson=0.5"),
        ("stretch=1000", "stretch=0"),
    ];
    for (from, to) in refused {
        let text = cloth().to_string();
        assert!(text.contains(from));
        assert_eq!(Body::parse(&text.replace(from, to)), None, "{to}");
    }
}

#[test]
fn a_cloth_has_two_sides_and_a_rim() {
    let soft = Soft::Body(cloth());
    let shape = Shape::of_soft(&soft, Appearance::new([0.5; 3])).unwrap();
    let mesh = &shape.parts[0].mesh;
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 12));
    assert!((mesh.vertices[0][2] - 0.001).abs() < 1e-9);
    assert!((mesh.vertices[4][2] + 0.001).abs() < 1e-9);
    // Closed: each edge is there once in each direction.
    let edges = mesh
        .triangles
        .iter()
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: std::collections::BTreeSet<_> = edges.collect();
    assert_eq!(edges.len(), 36);
    assert!(edges.iter().all(|[a, b]| edges.contains(&[*b, *a])));
    let torn = soft.mesh(soft.points(), &[true, false]);
    assert_eq!(torn.triangles.len(), 8);
}
