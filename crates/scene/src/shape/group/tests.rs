//! Groups of shapes, and what comes out of them again.

use super::*;

#[test]
fn masses_add_up() {
    let mut scene = Scene::new();
    let mut cube = || {
        let shape = Shape::primitive(PrimitiveKind::Cuboid, [0.1; 3], Default::default()).unwrap();
        scene.add("c", Kind::Shape(Box::new(shape))).unwrap()
    };
    let (a, b) = (cube(), cube());
    scene
        .set_world_pose(b, Pose::translation(0.4, 0.0, 0.0))
        .unwrap();
    let (group, members) = scene.group_shapes(&[a.raw(), 77, b.raw()], false).unwrap();
    let shape = scene.object(group).unwrap().shape().unwrap();
    assert_eq!((members, shape.parts.len()), (vec![a, b], 2));
    assert!((shape.mass.mass - 1.0).abs() < 1e-12 && (shape.mass.com[0] + 0.2).abs() < 1e-12);
    assert!(scene.group_shapes(&[a.raw()], false).is_err());
}

#[test]
fn the_result_has_both_names_of_the_last_shape() {
    for merge in [true, false] {
        let mut scene = Scene::new();
        let mut cube = |name: &str| {
            let shape =
                Shape::primitive(PrimitiveKind::Cuboid, [0.1; 3], Default::default()).unwrap();
            let cube = scene.add("c", Kind::Shape(Box::new(shape))).unwrap();
            scene.set_old_name(cube, name).unwrap();
            cube
        };
        let [first, last] = ["bolt", "nut#2"].map(&mut cube);
        let originals = [first.raw(), last.raw()];
        let (group, members) = scene.group_shapes(&originals, merge).unwrap();
        scene.remove(&members).unwrap();
        let group = scene.object(group).unwrap();
        assert_eq!((group.alias(), group.old_name()), ("c", "nut#2"), "{merge}");
        assert!(scene.find_old_name("nut#2").is_ok() && scene.find_old_name("bolt").is_err());
    }
}

#[test]
fn pieces_take_the_place_and_the_settings_of_their_group() {
    let mut scene = Scene::new();
    let mut cube = || {
        let shape = Shape::primitive(PrimitiveKind::Cuboid, [0.1; 3], Default::default()).unwrap();
        scene.add("c", Kind::Shape(Box::new(shape))).unwrap()
    };
    let [before, a, b, after] = [cube(), cube(), cube(), cube()];
    let (group, _) = scene
        .group_shapes(&[a.raw(), b.raw(), a.raw()], false)
        .unwrap();
    scene.remove(&[a, b]).unwrap();
    let data = Some((crate::ValueType::Int, crate::Data::Int(7)));
    let (namespace, edit) = (crate::Namespace::CustomData, crate::Edit::Name("x", data));
    scene
        .edit_named_values(Some(group), namespace, edit)
        .unwrap();
    let pieces = scene.ungroup_shape(group).unwrap().unwrap();
    let expected = [before, pieces[0], pieces[1], group, after];
    assert_eq!(scene.roots(), expected);
    let data = |piece: &Handle| scene.object(*piece).unwrap().custom_data.clone();
    assert!(pieces.iter().all(|piece| data(piece) == data(&group)));
}

#[test]
fn groups_of_groups_come_apart_level_by_level() {
    let mut scene = Scene::new();
    let mut cube = |x: f64| {
        let shape = Shape::primitive(PrimitiveKind::Cuboid, [0.1; 3], Default::default()).unwrap();
        let cube = scene.add("c", Kind::Shape(Box::new(shape))).unwrap();
        scene
            .set_world_pose(cube, Pose::translation(x, 0.0, 0.0))
            .unwrap();
        cube.raw()
    };
    let cubes = [cube(0.0), cube(1.0), cube(2.0), cube(3.0)];
    let pair = scene.group_shapes(&cubes[..2], false).unwrap().0;
    let three = scene
        .group_shapes(&[pair.raw(), cubes[2]], false)
        .unwrap()
        .0;
    let four = scene
        .group_shapes(&[three.raw(), cubes[3]], false)
        .unwrap()
        .0;
    let mut taken = |group| {
        let pieces = scene.ungroup_shape(group).unwrap().unwrap();
        let parts = |h: &Handle| scene.object(*h).unwrap().shape().unwrap().parts.len();
        (
            pieces.iter().map(parts).collect::<Vec<_>>(),
            scene.world_pose(pieces[0]).unwrap().translation.x,
            pieces[0],
        )
    };
    let (sizes, x, three) = taken(four);
    assert_eq!((sizes, x), (vec![3, 1], 2.0));
    let (sizes, x, pair) = taken(three);
    assert_eq!((sizes, x), (vec![2, 1], 1.0));
    assert_eq!(taken(pair).0, [1, 1]);
}
