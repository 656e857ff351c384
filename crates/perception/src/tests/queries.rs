//! Answers that follow from the geometry of a few objects: sensors and items.

use super::*;
use crate::items::Items;
use scene::SpecialFlags;

/// A cube of half a metre whose face that looks at a sensor at the origin is at z.
fn facing(scene: &mut Scene, z: f64) -> Handle {
    let pose = Pose::translation(0.0, 0.0, z + 0.25);
    primitive(scene, PrimitiveKind::Cuboid, [0.5; 3], pose)
}

fn set(scene: &mut Scene, sensor: Handle, change: impl FnOnce(&mut ProximitySensor)) {
    let change = |object: &mut scene::Object| change(object.proximity_sensor_mut().unwrap());
    scene.modify(sensor, Field::Sensor, change).unwrap();
}

fn seen(scene: &Scene, sensor: Handle) -> Option<f64> {
    let found = detect(&mut Perception::new(0, None), scene, sensor, Entity::All)?;
    assert!((found.detection.distance() - found.distance).abs() < 1e-9);
    Some(found.distance)
}

fn within(scene: &Scene, sensor: Handle, reach: f64) -> Option<f64> {
    let data = scene.object(sensor).unwrap().proximity_sensor().unwrap();
    let mode = DetectionMode::of(data).within(reach);
    let group = Entity::All.group(scene, Purpose::Detection);
    let found = Perception::new(0, None).detect(scene, sensor, &group, mode);
    found.unwrap().map(|found| found.distance)
}

#[test]
fn nothing_is_detected_where_something_is_too_near() {
    for volume in [VolumeType::Ray, VolumeType::Cone, VolumeType::Cylinder] {
        for exact in [true, false] {
            let mut scene = Scene::new();
            let sensor = sensor(&mut scene, volume);
            set(&mut scene, sensor, |data| data.exact = exact);
            facing(&mut scene, 0.75);
            for (limit, expected) in [(0.0, true), (0.5, true), (0.75, true), (0.875, false)] {
                set(&mut scene, sensor, |data| {
                    data.volume.close_threshold = limit;
                });
                assert_eq!(
                    seen(&scene, sensor).is_some(),
                    expected,
                    "{volume:?} {exact} {limit}"
                );
            }
            // What is near hides what is far.
            set(&mut scene, sensor, |data| data.volume.close_threshold = 0.5);
            facing(&mut scene, 0.125);
            assert_eq!(seen(&scene, sensor), None, "{volume:?} {exact}");
        }
    }
}

#[test]
fn a_dummy_at_the_limit_is_too_near() {
    let mut scene = Scene::new();
    let sensor = sensor(&mut scene, VolumeType::Cone);
    let dummy = scene.add("dummy", Kind::Dummy(Dummy::new(0.01))).unwrap();
    scene
        .set_world_pose(dummy, Pose::translation(0.0, 0.0, 0.5))
        .unwrap();
    let all = |object: &mut scene::Object| object.special_property = SpecialFlags::DETECTABLE;
    scene.modify(dummy, Field::SpecialProperty, all).unwrap();
    for (limit, expected) in [(0.499, Some(0.5)), (0.5, None)] {
        set(&mut scene, sensor, |data| {
            data.volume.close_threshold = limit;
        });
        assert_eq!(seen(&scene, sensor), expected);
    }
}

#[test]
fn a_ray_reaches_from_its_offset_as_far_as_its_range() {
    let mut scene = Scene::new();
    let sensor = sensor(&mut scene, VolumeType::Ray);
    set(&mut scene, sensor, |data| {
        (data.volume.offset, data.volume.range) = (0.5, 1.0);
    });
    let cube = facing(&mut scene, 0.75);
    let at = |scene: &mut Scene, z: f64| {
        scene
            .set_world_pose(cube, Pose::translation(0.0, 0.0, z + 0.25))
            .unwrap();
        seen(scene, sensor)
    };
    assert_eq!(at(&mut scene, 0.75), Some(0.75));
    assert_eq!(at(&mut scene, 1.4375), Some(1.4375));
    assert_eq!(at(&mut scene, 1.5625), None);
    // Of a cube before the offset only the far side is met, from within.
    assert_eq!(at(&mut scene, 0.125), Some(0.625));
    assert_eq!(at(&mut scene, -0.25), None);
    at(&mut scene, 0.75);
    assert_eq!(
        [within(&scene, sensor, 0.7), within(&scene, sensor, 0.8)],
        [None, Some(0.75)]
    );
}

#[test]
fn of_two_objects_that_are_equally_near_a_ray_meets_the_first() {
    let mut scene = Scene::new();
    let sensor = sensor(&mut scene, VolumeType::Ray);
    let first = facing(&mut scene, 0.75);
    facing(&mut scene, 0.75);
    let found = detect(&mut Perception::new(0, None), &scene, sensor, Entity::All).unwrap();
    assert_eq!(found.detection.object, first);
    assert_eq!(
        (found.detection.point, found.detection.normal),
        ([0.0, 0.0, 0.75], [0.0, 0.0, -1.0])
    );
}

#[test]
fn a_volume_that_changes_is_prepared_again() {
    let mut scene = Scene::new();
    let sensor = sensor(&mut scene, VolumeType::Cylinder);
    let (mut perception, _) = (Perception::new(0, None), facing(&mut scene, 0.75));
    let mut ask = |scene: &Scene| detect(&mut perception, scene, sensor, Entity::All).is_some();
    assert!(ask(&scene));
    set(&mut scene, sensor, |data| data.volume.range = 0.5);
    assert!(!ask(&scene));
    set(&mut scene, sensor, |data| data.volume.range = 1.0);
    assert!(ask(&scene));
}

/// A sensor with rays that all go along z, from an eye at 0.25, to a wall at 1.
fn straight(change: impl FnOnce(&mut ProximitySensor)) -> Option<f64> {
    let mut scene = Scene::new();
    let sensor = sensor(&mut scene, VolumeType::Ray);
    set(&mut scene, sensor, |data| {
        (data.randomized, data.samples, data.required_samples) = (true, 8, 8);
        let volume = &mut data.volume;
        (volume.offset, volume.range, volume.angle) = (0.25, 2.0, 0.0);
        volume.radius[0] = 0.125;
        change(data);
    });
    for z in [2.0, 1.0] {
        let wall = primitive(
            &mut scene,
            PrimitiveKind::Plane,
            [4.0, 4.0, 0.0],
            Pose::translation(0.0, 0.0, z),
        );
        assert!(scene.exists(wall));
    }
    seen(&scene, sensor)
}

#[test]
fn random_rays_begin_at_the_offset() {
    assert_eq!(straight(|_| ()), Some(1.0));
    assert_eq!(straight(|data| data.required_samples = 9), None);
    assert_eq!(straight(|data| data.volume.close_threshold = 1.5), None);
    assert_eq!(
        straight(|data| data.volume.close_threshold = 0.5),
        Some(1.0)
    );
    // The rays count from the radius on, as far as the range.
    assert_eq!(straight(|data| data.volume.radius[0] = 0.875), Some(2.0));
    assert_eq!(straight(|data| data.volume.range = 0.5), None);
    assert_eq!(straight(|data| data.volume.range = 0.75), Some(1.0));
}

fn asked(volume: VolumeType, item_type: i64, coordinates: &[f64]) -> Option<proximity::Hit> {
    let mut scene = Scene::new();
    let sensor = sensor(&mut scene, volume);
    let corners = 3 * (item_type as usize + 1);
    let items = Items::new(coordinates, item_type, (coordinates.len() / corners) as i64).unwrap();
    let mode = DetectionMode::from_options(3, 0.0).within(2.0);
    Perception::new(0, None)
        .detect_items(&scene, sensor, &items, mode)
        .unwrap()
}

#[track_caller]
fn is_at(hit: Option<proximity::Hit>, point: [f64; 3]) {
    let hit = hit.expect("it is detected");
    let distance = Vector3::from(point).norm();
    assert!(
        (Vector3::from(hit.point) - Vector3::from(point)).norm() < 1e-9,
        "{hit:?}"
    );
    assert!((hit.distance - distance).abs() < 1e-9, "{hit:?}");
}

#[test]
fn items_in_a_volume() {
    let cone = VolumeType::Cone;
    is_at(
        asked(cone, 0, &[0.0, 0.0, 1.0, 0.0, 0.125, 0.5]),
        [0.0, 0.125, 0.5],
    );
    assert_eq!(
        asked(cone, 0, &[0.0, 0.0, -1.0, 5.0, 0.0, 0.5, 0.0, 0.0, 2.5]),
        None
    );
    // The foot of the perpendicular, or the end that is nearer.
    is_at(
        asked(cone, 1, &[-5.0, 0.0, 1.0, 5.0, 0.0, 1.0]),
        [0.0, 0.0, 1.0],
    );
    is_at(
        asked(cone, 1, &[0.25, 0.0, 1.0, 5.0, 0.0, 1.0]),
        [0.25, 0.0, 1.0],
    );
    is_at(
        asked(cone, 1, &[0.0, 0.0, 1.5, 0.0, 0.0, 0.75]),
        [0.0, 0.0, 0.75],
    );
    is_at(
        asked(cone, 1, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]),
        [0.0, 0.0, 1.0],
    );
    let both = [
        0.0, 0.0, 1.5, 0.0, 0.25, 1.5, 0.0, 0.0, 1.25, 0.0, 0.25, 1.25,
    ];
    is_at(asked(cone, 1, &both), [0.0, 0.0, 1.25]);
    assert_eq!(asked(cone, 1, &[5.0, 0.0, 1.0, 6.0, 0.0, 1.0]), None);
    assert_eq!(asked(cone, 1, &[-1.0, 0.0, 2.5, 1.0, 0.0, 2.5]), None);
    assert_eq!(asked(cone, 1, &[f64::NAN, 0.0, 1.0, 5.0, 0.0, 1.0]), None);
    is_at(
        asked(cone, 2, &[-1.0, -1.0, 1.0, 1.0, -1.0, 1.0, 0.0, 2.0, 1.0]),
        [0.0, 0.0, 1.0],
    );
}

/// Along the axis and 0.3 m beside it: a cone whose half angle is 0.6 rad is as wide at 0.3 m over the tangent of that, but for its facets.
#[test]
fn a_segment_enters_a_cone_at_its_side() {
    for beside in [[0.3, 0.0], [-0.3, 0.0], [0.0, 0.3]] {
        let [x, y] = beside;
        let hit = asked(VolumeType::Cone, 1, &[x, y, 0.0, x, y, 1.5]).expect("it enters");
        let expected = 0.3 / 0.6_f64.tan();
        assert!((hit.point[2] / expected - 1.0).abs() < 0.03, "{hit:?}");
        assert!((hit.point[0] - x).abs() < 1e-9 && (hit.point[1] - y).abs() < 1e-9);
    }
}

#[test]
fn rays_see_triangles_only() {
    let ray = VolumeType::Ray;
    is_at(
        asked(ray, 2, &[-1.0, -1.0, 1.0, 1.0, -1.0, 1.0, 0.0, 2.0, 1.0]),
        [0.0, 0.0, 1.0],
    );
    assert_eq!(
        asked(ray, 2, &[-1.0, -1.0, 2.5, 1.0, -1.0, 2.5, 0.0, 2.0, 2.5]),
        None
    );
    assert_eq!(
        [
            asked(ray, 0, &[0.0, 0.0, 1.0]),
            asked(ray, 1, &[-1.0, 0.0, 1.0, 1.0, 0.0, 1.0])
        ],
        [None; 2]
    );
}

#[test]
fn a_segment_through_a_gap_is_met_at_its_border() {
    let mut scene = Scene::new();
    let sensor = sensor(&mut scene, VolumeType::Cylinder);
    set(&mut scene, sensor, |data| {
        let volume = &mut data.volume;
        (volume.radius, volume.inside_gap, volume.faces) = ([1.0; 2], 0.5, [64; 2]);
    });
    let ask = |coordinates: &[f64]| {
        let items = Items::new(coordinates, 1, 1).unwrap();
        let mode = DetectionMode::from_options(3, 0.0);
        Perception::new(0, None)
            .detect_items(&scene, sensor, &items, mode)
            .unwrap()
    };
    let hit = ask(&[-5.0, 0.0, 1.0, 5.0, 0.0, 1.0]).unwrap();
    // Half of the radius is left out; the border is a polygon.
    assert!((hit.point[0].abs() - 0.5).abs() < 2e-3, "{hit:?}");
    assert!(ask(&[-0.25, 0.0, 1.0, 0.25, 0.0, 1.0]).is_none());
    assert!((ask(&[0.0, 0.0, 1.0, 0.75, 0.0, 1.0]).unwrap().point[0] - 0.5).abs() < 2e-3);
    assert!((ask(&[0.75, 0.0, 1.0, 5.0, 0.0, 1.0]).unwrap().point[0] - 0.75).abs() < 1e-9);
}

#[test]
fn items_need_their_coordinates() {
    let numbers = [0.0; 17];
    for (item_type, count, is_right) in [
        (0, 5, true),
        (0, 6, false),
        (1, 2, true),
        (1, 3, false),
        (2, 1, true),
        (2, 2, false),
        (3, 1, false),
        (-1, 1, false),
        (0, -1, false),
        (2, i64::MAX, false),
    ] {
        assert_eq!(
            Items::new(&numbers, item_type, count).is_ok(),
            is_right,
            "{item_type} {count}"
        );
    }
}
