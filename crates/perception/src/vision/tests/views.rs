//! Lights, fog, backgrounds, and where a scene without a camera is seen from.

use std::f64::consts::{FRAC_PI_4, SQRT_2};

use super::pictures::{SIDE, cloud, studio};
use super::*;
use crate::vision::views::Viewpoint;
use crate::vision::{Backdrop, views_background};
use nalgebra::Vector3;
use scene::appearance::environment::FogType;
use scene::sensor::Camera;
use scene::voxels::point_cloud::CloudPoint;
use scene::{ObjectFlags, Settings};

/// The middle and a corner of the picture of a white wall at 2 m under one light at the sensor.
fn lit(change: impl FnOnce(&mut Light)) -> [u8; 2] {
    let mut studio = studio();
    let mut wall =
        Shape::primitive(PrimitiveKind::Cuboid, [8.0, 8.0, 0.1], Default::default()).unwrap();
    let colour = &mut wall.parts[0].appearance.colour;
    (colour.ambient_diffuse, colour.specular) = ([1.0; 3], [0.0; 3]);
    let wall = studio
        .scene
        .add("wall", Kind::Shape(Box::new(wall)))
        .unwrap();
    studio
        .scene
        .set_world_pose(wall, Pose::translation(0.0, 0.0, 2.05))
        .unwrap();
    studio
        .scene
        .modify_settings(|settings| settings.environment.ambient_light = [0.0; 3]);
    let mut light = Light::new(LightType::Directional);
    (light.attenuation, light.spot_exponent) = ([1.0, 0.0, 0.0], 0);
    change(&mut light);
    studio
        .scene
        .add("light", Kind::Light(Box::new(light)))
        .unwrap();
    let picture = studio.picture();
    [SIDE / 2 * SIDE + SIDE / 2, 0].map(|at| picture.colour[3 * at])
}

#[test]
fn lights_of_all_types() {
    assert_eq!(lit(|_| ()), [128, 128]);
    assert_eq!(lit(|light| light.enabled = false), [0, 0]);
    let spot = lit(|light| (light.light_type, light.spot_cutoff) = (LightType::Spot, 0.25));
    assert!(spot[0] > 120 && spot[1] == 0, "{spot:?}");
    let omni = lit(|light| light.light_type = LightType::Omnidirectional);
    assert!(
        omni[0] > 120 && (50..omni[0]).contains(&omni[1]),
        "{omni:?}"
    );
    // Half at the distance of two metres.
    let faded = lit(|light| {
        (light.light_type, light.attenuation) = (LightType::Omnidirectional, [0.0, 1.0, 0.0]);
    });
    assert!(faded[0].abs_diff(64) < 3, "{faded:?}");
}

fn settings(studio: &mut Studio, change: impl FnOnce(&mut Settings)) {
    studio.scene.modify_settings(change);
}

#[test]
fn fog_grows_with_distance() {
    for (fog_type, start, end, density, share) in [
        (FogType::LINEAR, 0.0, Some(3.5), 0.0, 0.5),
        (FogType::LINEAR, 0.0, None, 0.0, 0.35),
        (FogType::EXPONENTIAL, 0.0, None, 0.5, 0.583),
        (FogType::EXPONENTIAL_SQUARED, 0.0, None, 0.5, 0.535),
    ] {
        let mut studio = Studio::new();
        studio.cube(2.0);
        settings(&mut studio, |settings| {
            let fog = &mut settings.environment.fog;
            (fog.enabled, fog.fog_type, fog.start) = (true, fog_type, start);
            (fog.end, fog.density, fog.colour) = (end, density, Some([0.0, 0.0, 1.0]));
        });
        let [red, _, blue] = studio.middle().0.map(|part| f64::from(part) / 255.0);
        assert!(
            (blue - share).abs() < 0.01 && (red - 1.0 + share).abs() < 0.01,
            "{fog_type:?} {red} {blue}"
        );
        let ignore =
            |object: &mut scene::Object| object.vision_sensor_mut().unwrap().ignore_fog = true;
        studio
            .scene
            .modify(studio.sensor, Field::Sensor, ignore)
            .unwrap();
        assert_eq!(studio.middle().0, [255, 0, 0]);
    }
}

#[test]
fn backgrounds_of_sensors_and_views() {
    let mut studio = Studio::new();
    let own = |object: &mut scene::Object| {
        object.vision_sensor_mut().unwrap().background = [0.2, 0.4, 0.6];
    };
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, own)
        .unwrap();
    assert_eq!(studio.middle().0, [51, 102, 153]);
    let of_scene = |object: &mut scene::Object| {
        object
            .vision_sensor_mut()
            .unwrap()
            .background_from_environment = true;
    };
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, of_scene)
        .unwrap();
    settings(&mut studio, |settings| {
        settings.environment.fog.colour = Some([0.6, 0.2, 0.4]);
    });
    assert_eq!(studio.middle().0, [153, 51, 102]);
    let colours = [[0.5, 0.25, 0.75], [0.0, 1.0, 0.5]];
    settings(&mut studio, |settings| {
        settings.environment.background = Some(colours);
    });
    assert_eq!(views_background(&studio.scene), colours);
    let shown = Backdrop::Views.colours(&studio.scene);
    assert_eq!([shown.top, shown.bottom], colours);
}

#[test]
fn auxiliary_colours_need_no_light() {
    let mut studio = Studio::new();
    let cube = studio.cube(2.0);
    let paint = |object: &mut scene::Object| {
        object.shape_mut().unwrap().parts[0]
            .appearance
            .colour
            .auxiliary = [0.2, 0.4, 0.6];
    };
    studio.scene.modify(cube, Field::Appearance, paint).unwrap();
    let mode = |object: &mut scene::Object| {
        object.vision_sensor_mut().unwrap().render_mode = RenderMode::AUXILIARY;
    };
    studio
        .scene
        .modify(studio.sensor, Field::Sensor, mode)
        .unwrap();
    assert_eq!(studio.middle().0, [51, 102, 153]);
}

/// Where a view without a camera is from, and what it looks along.
fn overview(scene: &Scene) -> (Vector3<f64>, Vector3<f64>, f64) {
    let shot = Viewpoint::new(scene, None)
        .unwrap()
        .shot(scene, [64, 32])
        .unwrap();
    assert_eq!(shot.view.resolution, [64, 32]);
    let ahead = shot.pose.rotation * Vector3::z();
    (shot.pose.translation.vector, ahead, shot.view.clipping[1])
}

#[track_caller]
fn looks_at(scene: &Scene, middle: [f64; 3], radius: f64) {
    let (eye, ahead, far) = overview(scene);
    let direction = Vector3::new(-1.0, -1.5, 1.2).normalize();
    // The ball fills the angle of 60 degrees, and a tenth is left free.
    let expected = Vector3::from(middle) + direction * (1.1 * radius / 0.5);
    assert!((eye - expected).norm() < 1e-9, "{eye} is not {expected}");
    assert!((ahead + direction).norm() < 1e-9);
    assert!((far - (4.0 * eye.norm()).max(30.0)).abs() < 1e-9);
}

#[test]
fn a_view_from_anywhere_looks_at_its_target() {
    let scene = Studio::new().scene;
    for (eye, target) in [
        ([3.0, 0.0, 1.0], [0.0, 0.0, 1.0]),
        ([1.0, 2.0, 3.0], [-1.0, 0.5, 0.0]),
        // Where no direction is up.
        ([0.0, 0.0, 2.0], [0.0, 0.0, 0.0]),
        ([0.5, 0.5, -1.0], [0.5, 0.5, 40.0]),
    ] {
        let viewpoint = Viewpoint::looking(eye, target);
        let shot = viewpoint.shot(&scene, [64, 32]).unwrap();
        let wanted = Vector3::from(target) - Vector3::from(eye);
        let ahead = shot.pose.rotation * Vector3::z();
        assert!((ahead - wanted.normalize()).norm() < 1e-9, "{eye:?}");
        assert_eq!(shot.pose.translation.vector, Vector3::from(eye));
        assert!(shot.view.clipping[1] > wanted.norm(), "{eye:?}");
    }
}

#[test]
fn a_view_without_a_camera_shows_a_ball_around_all() {
    let mut studio = Studio::new();
    looks_at(&studio.scene, [0.0; 3], 1.0);
    let cube = studio.cube(2.0);
    looks_at(&studio.scene, [0.0, 0.0, 2.0], 0.25 * 3_f64.sqrt());
    let far = studio.cube(40.0);
    looks_at(
        &studio.scene,
        [0.0, 0.0, 21.0],
        (38.5 * 38.5 + 0.5_f64).sqrt() / 2.0,
    );
    let skip =
        |object: &mut scene::Object| object.object_property |= ObjectFlags::IGNORE_VIEW_FITTING;
    studio
        .scene
        .modify(far, Field::ObjectProperty, skip)
        .unwrap();
    looks_at(&studio.scene, [0.0, 0.0, 2.0], 0.25 * 3_f64.sqrt());
    studio.scene.remove(&[cube]).unwrap();
    let mut tree = OcTree::new(1.0, 1.0);
    for x in [0.5, 4.5] {
        tree.insert(
            [x, 0.5, 0.5],
            Voxel {
                colour: [0; 3],
                tag: 0,
            },
        );
    }
    studio
        .scene
        .add("tree", Kind::OcTree(Box::new(tree)))
        .unwrap();
    looks_at(&studio.scene, [2.5, 0.5, 0.5], 2.0);
    let everything: Vec<Handle> = studio.scene.objects().map(scene::Object::handle).collect();
    studio.scene.remove(&everything).unwrap();
    let mut cloud = cloud(1.0);
    let point = |x: f64| CloudPoint {
        position: [x, 2.0, 3.0],
        colour: [0; 3],
    };
    cloud.insert([-1.0, 5.0].map(point).into_iter(), 0.0);
    let cloud = Kind::PointCloud(Box::new(cloud));
    studio.scene.add("cloud", cloud).unwrap();
    looks_at(&studio.scene, [2.0, 2.0, 3.0], 3.0);
}

#[test]
fn what_is_turned_reaches_as_far_as_its_points() {
    let places = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(|[x, y]| [x, y, 0.5]);
    let mut points = cloud(1.0);
    let point = |position| CloudPoint {
        position,
        colour: [0; 3],
    };
    points.insert(places.map(point).into_iter(), 0.0);
    let mut tree = OcTree::new(1.0, 1.0);
    let voxel = Voxel {
        colour: [0; 3],
        tag: 0,
    };
    // The centres of the voxels are half a metre beside.
    let beside = places.map(|[x, y, z]| [x + 0.5, y + 0.5, z]);
    beside
        .into_iter()
        .for_each(|place| tree.insert(place, voxel));
    let turn = Pose::new([0.0; 3].into(), [0.0, 0.0, FRAC_PI_4].into());
    let side = SQRT_2;
    let block = Shape::primitive(PrimitiveKind::Cuboid, [side; 3], Default::default()).unwrap();
    let mut scene = Scene::new();
    let block = scene.add("block", Kind::Shape(Box::new(block))).unwrap();
    scene.set_world_pose(block, turn).unwrap();
    looks_at(&scene, [0.0; 3], (4.0 + 4.0 + 2.0_f64).sqrt() / 2.0);
    let kinds = [
        (Kind::PointCloud(Box::new(points)), 0.0),
        (Kind::OcTree(Box::new(tree)), 0.5),
    ];
    for (kind, middle) in kinds {
        let mut scene = Scene::new();
        let object = scene.add("object", kind).unwrap();
        scene.set_world_pose(object, turn).unwrap();
        // An eighth of a turn makes a square of two metres from corner to corner one that is upright.
        let centre = turn * nalgebra::Point3::new(middle, middle, 0.5);
        looks_at(&scene, centre.coords.into(), 1.0);
    }
}

#[test]
fn viewpoints_are_objects_or_places() {
    let mut studio = Studio::new();
    let camera = studio
        .scene
        .add("camera", Kind::Camera(Box::<Camera>::default()))
        .unwrap();
    let scene = &mut studio.scene;
    let of_sensor = Viewpoint::new(scene, Some(studio.sensor)).unwrap();
    assert_eq!(of_sensor.resolution(scene), Some([9, 9]));
    let of_camera = Viewpoint::new(scene, Some(camera)).unwrap();
    assert_eq!(of_camera.resolution(scene), None);
    let place = Viewpoint::new(scene, None).unwrap();
    assert_eq!(place.resolution(scene), None);
    let moved = Pose::translation(1.0, 2.0, 3.0);
    scene.set_world_pose(camera, moved).unwrap();
    assert_eq!(of_camera.shot(scene, [4, 4]).unwrap().pose, moved);
    scene.remove(&[camera]).unwrap();
    assert!(of_camera.shot(scene, [4, 4]).is_err() && place.shot(scene, [4, 4]).is_ok());
    let cube = studio.cube(1.0);
    assert!(Viewpoint::new(&studio.scene, Some(cube)).is_err());
}
