//! Front and back faces: a closed cube seen from outside and from inside.

use proximity::Filter;

use super::*;

/// Half the width of the cube, and how far its centre is from the sensor that looks at it from outside, metres.
const HALF: f64 = 0.1;
const AWAY: f64 = 1.0;

/// The distance that a sensor with these options measures to the cube, which is around the sensor or before it.
fn measured(volume: VolumeType, options: ProximityOptions, is_inside: bool) -> Option<f64> {
    let (mut scene, mut perception) = (Scene::new(), Perception::new(0, None));
    let centre = if is_inside { 0.0 } else { AWAY };
    let pose = Pose::translation(0.0, 0.0, centre);
    primitive(&mut scene, PrimitiveKind::Cuboid, [2.0 * HALF; 3], pose);
    let sensor = sensor(&mut scene, volume);
    let faces = |object: &mut scene::Object| {
        let data = object.proximity_sensor_mut().unwrap();
        data.front_faces = !options.contains(ProximityOptions::IGNORE_FRONT_FACES);
        data.back_faces = !options.contains(ProximityOptions::IGNORE_BACK_FACES);
    };
    scene.modify(sensor, Field::Sensor, faces).unwrap();
    detect(&mut perception, &scene, sensor, Entity::All).map(|found| found.distance)
}

#[track_caller]
fn is_near(found: Option<f64>, expected: Option<f64>) {
    let same = match (found, expected) {
        (Some(found), Some(expected)) => (found - expected).abs() < 1e-9,
        (found, expected) => found == expected,
    };
    assert!(same, "{found:?} is not {expected:?}");
}

#[test]
fn back_faces_are_detected_only_where_they_count() {
    let no_front = ProximityOptions::IGNORE_FRONT_FACES;
    let no_back = ProximityOptions::IGNORE_BACK_FACES;
    for volume in [VolumeType::Ray, VolumeType::Cone, VolumeType::Cylinder] {
        let all = ProximityOptions::empty();
        is_near(measured(volume, all, true), Some(HALF));
        is_near(measured(volume, no_front, true), Some(HALF));
        is_near(measured(volume, no_back, true), None);
        is_near(measured(volume, all, false), Some(AWAY - HALF));
        is_near(measured(volume, no_back, false), Some(AWAY - HALF));
        is_near(measured(volume, no_front | no_back, false), None);
    }
    // Through the open front, a ray meets the far side from within.
    let far = Some(AWAY + HALF);
    is_near(measured(VolumeType::Ray, no_front, false), far);
}

#[test]
fn options_of_scripts_choose_the_faces() {
    let faces = |options: i64| {
        let Filter { front, back, .. } = DetectionMode::from_options(options, 0.0).filter;
        (front, back)
    };
    assert_eq!(
        [0, 1, 2, 3, 4].map(faces),
        [
            (true, false),
            (true, false),
            (false, true),
            (true, true),
            (true, false)
        ]
    );
    let of = |options: i64, angle: f64| DetectionMode::from_options(options, angle).filter;
    assert_eq!((of(4, 0.0).any, of(3, 0.0).any), (true, false));
    assert_eq!(
        (of(8, 0.5).max_angle, of(7, 0.5).max_angle),
        (Some(0.5), None)
    );
}

#[test]
fn nothing_beyond_a_threshold_is_detected() {
    let mode = DetectionMode::from_options(3, 0.0);
    assert_eq!(mode.within(0.5).reach, 0.5);
    assert_eq!(mode.within(0.0).reach, f64::INFINITY);
    assert_eq!(mode.within(-1.0).reach, f64::INFINITY);
}
