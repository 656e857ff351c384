//! Rays: how obliquely they may meet a surface, how random ones are spread, and what is too near.

use super::*;
use scene::sensor::Detection;

fn set(scene: &mut Scene, sensor: Handle, change: impl FnOnce(&mut ProximitySensor)) {
    let change = |object: &mut scene::Object| change(object.proximity_sensor_mut().unwrap());
    scene.modify(sensor, Field::Sensor, change).unwrap();
}

fn found(scene: &Scene, sensor: Handle) -> Option<Detected> {
    detect(&mut Perception::new(0, None), scene, sensor, Entity::All)
}

#[test]
fn surfaces_count_up_to_the_largest_angle() {
    for (limit, turn, is_seen) in [(0.8, 0.7, true), (0.8, 0.9, false), (0.0, 1.5, true)] {
        let mut scene = Scene::new();
        let ray = sensor(&mut scene, VolumeType::Ray);
        set(&mut scene, ray, |data| data.angle_threshold = limit);
        let pose = Pose::new([0.0, 0.0, 1.0].into(), [turn, 0.0, 0.0].into());
        primitive(&mut scene, PrimitiveKind::Plane, [0.5, 0.5, 0.0], pose);
        assert_eq!(found(&scene, ray).is_some(), is_seen, "{limit} {turn}");
    }
}

/// Directions that are equally likely in a cone have a z that is evenly spread from the cosine c of half its angle to 1: so far is a
/// plane at one metre on average, -ln(c) / (1 - c), and so far from the axis it is met, nowhere on average.
#[test]
fn random_rays_fill_their_cone_evenly() {
    let mut scene = Scene::new();
    let ray = sensor(&mut scene, VolumeType::Ray);
    set(&mut scene, ray, |data| {
        (data.randomized, data.samples, data.required_samples) = (true, 10_000, 10_000);
    });
    let pose = Pose::translation(0.0, 0.0, 1.0);
    primitive(&mut scene, PrimitiveKind::Plane, [10.0, 10.0, 0.0], pose);
    let found = found(&scene, ray).unwrap();
    let cosine = 0.6_f64.cos();
    let expected = -cosine.ln() / (1.0 - cosine);
    assert!((found.distance - expected).abs() < 3e-3, "{found:?}");
    let [x, y, z] = found.detection.point;
    assert!(x.hypot(y) < 0.02 && (z - 1.0).abs() < 1e-9, "{found:?}");
}

/// Small triangles of a mesh from 0.25 m on across a ray, and large ones from 1 m on. The box around the large ones begins before the
/// small ones, so that a search for any of them finds a large one first.
fn near_and_far() -> geometry::Mesh {
    let small = [[-0.1, -0.1, 0.25], [0.1, -0.1, 0.25], [0.0, 0.1, 0.25]];
    let large = [[-1.0, -1.0, 0.125], [-1.0, 1.0, 0.125], [1.0, 0.0, 1.875]];
    let behind = |[x, y, z]: [f64; 3], at: u32| [x, y, z + 0.01 * f64::from(at)];
    let all = (0..4).flat_map(|at| [small, large].map(|corners| corners.map(|c| behind(c, at))));
    let vertices: Vec<[f64; 3]> = all.flatten().collect();
    let triangles = (0..8).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]);
    geometry::Mesh::new(vertices, triangles.collect()).unwrap()
}

#[test]
fn what_is_too_near_counts_where_any_surface_will_do() {
    for exact in [true, false] {
        let mut scene = Scene::new();
        let ray = sensor(&mut scene, VolumeType::Ray);
        let shape = cuboid(&mut scene, 0.0);
        let change = |object: &mut scene::Object| {
            object.shape_mut().unwrap().parts[0].mesh = std::rc::Rc::new(near_and_far());
        };
        scene.modify(shape, Field::Geometry, change).unwrap();
        set(&mut scene, ray, |data| data.exact = exact);
        let expected = if exact { 0.25 } else { 1.0 };
        assert_eq!(
            found(&scene, ray).map(|found| found.distance),
            Some(expected)
        );
        set(&mut scene, ray, |data| data.volume.close_threshold = 0.5);
        assert_eq!(found(&scene, ray), None, "{exact}");
    }
}

/// Two walls across the rays, at 1 m and 2 m, each a part of one shape, in either order.
#[test]
fn of_the_parts_of_a_shape_the_nearest_is_met() {
    for distances in [[1.0, 2.0], [2.0, 1.0]] {
        let mut scene = Scene::new();
        let ray = sensor(&mut scene, VolumeType::Ray);
        let wall = Pose::identity();
        let shape = primitive(&mut scene, PrimitiveKind::Plane, [4.0, 4.0, 0.0], wall);
        let double = |object: &mut scene::Object| {
            let parts = &mut object.shape_mut().unwrap().parts;
            parts.push(parts[0].clone());
            for (part, z) in parts.iter_mut().zip(distances) {
                part.pose = Pose::translation(0.0, 0.0, z);
            }
        };
        scene.modify(shape, Field::Geometry, double).unwrap();
        for randomized in [false, true] {
            set(&mut scene, ray, |data| {
                (data.randomized, data.samples, data.required_samples) = (randomized, 5, 5);
                data.volume.angle = 0.0;
            });
            let found = found(&scene, ray).unwrap().distance;
            assert!((found - 1.0).abs() < 1e-9, "{distances:?} {found}");
        }
    }
}

#[test]
fn of_a_list_the_nearest_is_met_wherever_it_stands() {
    let mut scene = Scene::new();
    let ray = sensor(&mut scene, VolumeType::Ray);
    let walls = [2.0, 1.0, 1.5].map(|z| {
        let pose = Pose::translation(0.0, 0.0, z);
        primitive(&mut scene, PrimitiveKind::Plane, [4.0, 4.0, 0.0], pose)
    });
    let group = crate::entity::Group::List(walls.to_vec());
    let mode = DetectionMode::from_options(3, 0.0);
    let found = Perception::new(0, None).detect(&scene, ray, &group, mode);
    assert_eq!(found.unwrap().unwrap().detection.object, walls[1]);
}

#[test]
fn no_number_is_a_zero_with_a_sign() {
    let quarter = std::f64::consts::FRAC_PI_2;
    for turn in [[0.0; 3], [quarter, 0.0, 0.0], [0.0, quarter, 0.0]] {
        for (volume, way) in [(VolumeType::Ray, 1.0), (VolumeType::Ray, -1.0)] {
            let mut scene = Scene::new();
            let ray = sensor(&mut scene, volume);
            let pose = Pose::new([0.0, 0.0, 1.0].into(), turn.map(|angle| way * angle).into());
            primitive(&mut scene, PrimitiveKind::Cuboid, [0.5; 3], pose);
            let Detection { point, normal, .. } = found(&scene, ray).unwrap().detection;
            let is_plain = |c: &f64| *c != 0.0 || c.is_sign_positive();
            assert!(
                point.iter().chain(&normal).all(is_plain),
                "{point:?} {normal:?}"
            );
        }
    }
}

#[test]
fn the_random_numbers_begin_again_with_a_seed() {
    let mut scene = Scene::new();
    let ray = sensor(&mut scene, VolumeType::Ray);
    set(&mut scene, ray, |data| {
        (data.randomized, data.samples) = (true, 1);
    });
    let pose = Pose::translation(0.0, 0.0, 1.0);
    primitive(&mut scene, PrimitiveKind::Plane, [10.0, 10.0, 0.0], pose);
    let mut perception = Perception::new(3, None);
    let next = |perception: &mut Perception| {
        let found = detect(perception, &scene, ray, Entity::All);
        found.unwrap().distance
    };
    let [first, second] = [0; 2].map(|_| next(&mut perception));
    assert_ne!(first, second);
    perception.set_seed(3);
    assert_eq!(next(&mut perception), first);
    perception.set_seed(4);
    assert_ne!(next(&mut perception), first);
}
