//! Sensors, cameras and lights.

use super::{object, objects, one};
use crate::ttt::chunks::{
    Camera, Colour, Light, ProximitySensor as Proximity, VisionSensor as Vision, Volume,
};
use crate::ttt::tree::Class;
use scene::Kind;
use scene::sensor::volume::VolumeType;
use scene::sensor::{Entity, LightType, ProximitySensor, RenderMode, VisionSensor};

fn proximity(chunk: Proximity) -> ProximitySensor {
    let object = one(Class::ProximitySensor(Box::new(chunk)));
    object.proximity_sensor().unwrap().clone()
}

fn vision(chunk: Vision) -> VisionSensor {
    one(Class::VisionSensor(Box::new(chunk)))
        .vision_sensor()
        .unwrap()
        .clone()
}

#[test]
fn limits_of_angle_and_distance_had_a_switch() {
    let angle = |switches, old_angle_threshold, angle_threshold| {
        proximity(Proximity {
            switches: Some(switches),
            old_angle_threshold,
            angle_threshold,
            ..Proximity::default()
        })
        .angle_threshold
    };
    assert_eq!(
        [angle(0x4, Some(0.5), None), angle(0xfb, Some(0.5), None)],
        [0.5, 0.0]
    );
    assert_eq!(
        [angle(0x4, Some(0.5), Some(0.25)), angle(0x4, None, None)],
        [0.25, 0.0]
    );
    let distance = |switches, old_smallest_distance, smallest_distance| {
        let volume = Volume {
            switches: Some(switches),
            old_smallest_distance,
            smallest_distance,
            ..Volume::default()
        };
        proximity(Proximity {
            volume: Some(volume),
            ..Proximity::default()
        })
        .volume
        .close_threshold
    };
    assert_eq!(
        [
            distance(1, Some(0.5), None),
            distance(0xfe, Some(0.5), None)
        ],
        [0.5, 0.0]
    );
    assert_eq!(
        [distance(0, Some(0.5), Some(0.25)), distance(1, None, None)],
        [0.25, 0.0]
    );
}

#[test]
fn switches_of_proximity_sensors() {
    let flags = |first, second| {
        let sensor = proximity(Proximity {
            switches: Some(first),
            switches_2: Some(second),
            ..Proximity::default()
        });
        let faces = [sensor.front_faces, sensor.back_faces];
        (
            faces,
            [
                sensor.show_volume,
                sensor.exact,
                sensor.explicit,
                sensor.randomized,
            ],
        )
    };
    assert_eq!(flags(0, 0), ([true; 2], [false; 4]));
    assert_eq!(flags(0x1, 0x2), ([true; 2], [true, false, false, true]));
    assert_eq!(
        flags(0x12, 0x1),
        ([false, true], [false, true, false, false])
    );
    assert_eq!(
        flags(0xa0, 0xfd),
        ([true, false], [false, false, true, false])
    );
    let nothing = proximity(Proximity::default());
    assert_eq!(
        (nothing.volume.volume_type, nothing.entity),
        (VolumeType::Ray, Entity::ALL)
    );
    assert_eq!((nothing.samples, nothing.required_samples), (1, 1));
}

#[test]
fn entities_that_are_gone_are_everything() {
    let seen = |handle| {
        let sensor = Proximity {
            detectable: Some(handle),
            ..Proximity::default()
        };
        let camera = Vision {
            renderable: Some(handle),
            ..Vision::default()
        };
        let all = vec![
            object(1, -1, Class::ProximitySensor(Box::new(sensor))),
            object(2, -1, Class::VisionSensor(Box::new(camera))),
        ];
        let (scene, handles) = objects(41_000, 25, all);
        let at = |at: usize| scene.object(handles[at]).unwrap();
        let entities = [
            at(0).proximity_sensor().unwrap().entity,
            at(1).vision_sensor().unwrap().entity,
        ];
        entities.map(|entity| {
            handles
                .iter()
                .position(|handle| entity == (*handle).into())
                .ok_or(entity)
        })
    };
    assert_eq!(seen(2), [Ok(1), Ok(1)]);
    for gone in [0, 7, 999_999, 2_000_000] {
        assert_eq!(seen(gone), [Err(Entity::ALL); 2], "{gone}");
    }
    assert_eq!(seen(-1), [Err(Entity::ALL); 2]);
}

#[test]
fn switches_of_vision_sensors() {
    let flags = |third, second| {
        let s = vision(Vision {
            switches_3: Some(third),
            switches_2: Some(second),
            ..Vision::default()
        });
        let third = [
            (s.view.perspective, 0),
            (s.explicit, 1),
            (s.ignore_fog, 2),
            (s.view.show_frustum, 4),
            (s.local_lights, 6),
            (s.background_from_environment, 7),
        ];
        let second = [
            (s.external_image, 0),
            (s.ignore_image, 1),
            (s.ignore_depth, 2),
            (s.omit_statistics, 4),
        ];
        let bits = |flags: &[(bool, u8)]| {
            flags
                .iter()
                .map(|(on, bit)| u8::from(*on) << bit)
                .sum::<u8>()
        };
        (bits(&third), bits(&second))
    };
    for bit in 0..8 {
        let switches: u8 = 1 << bit;
        assert_eq!(
            flags(switches, switches),
            (switches & 0xd7, switches & 0x17),
            "{bit}"
        );
    }
}

#[test]
fn vision_sensors_of_old_files() {
    let sensor = vision(Vision {
        old_size: Some([0.5, 1.0, 2.0]),
        render_mode: Some(6),
        ..Vision::default()
    });
    assert_eq!(
        (sensor.size, sensor.render_mode),
        (0.5, RenderMode::EXTERNAL)
    );
    let sensor = vision(Vision {
        old_size: Some([0.5, 1.0, 2.0]),
        size: Some(0.25),
        render_mode: Some(8),
        ..Vision::default()
    });
    assert_eq!(
        (sensor.size, sensor.render_mode),
        (0.25, RenderMode::OPENGL3)
    );
    let default = vision(Vision::default());
    assert_eq!(
        (default.view.resolution, default.render_mode),
        ([16, 16], RenderMode(0))
    );
    let seven = vision(Vision {
        render_mode: Some(1),
        ..Vision::default()
    });
    assert_eq!(seven.render_mode, RenderMode(1));
}

#[test]
fn cameras_say_in_two_places_whether_they_are_perspective() {
    let perspective = |switches_2, cpm| {
        let camera = Camera {
            cpm,
            switches_2,
            ..Camera::default()
        };
        let object = one(Class::Camera(Box::new(camera)));
        let Kind::Camera(camera) = object.kind else {
            panic!("no camera")
        };
        camera.view.perspective
    };
    assert_eq!(
        [
            perspective(Some(2), Some(0)),
            perspective(Some(0xfd), Some(1))
        ],
        [true, false]
    );
    assert_eq!(
        [
            perspective(None, Some(1)),
            perspective(None, Some(0)),
            perspective(None, None)
        ],
        [true, false, true]
    );
}

#[test]
fn lights() {
    let light = |chunk: Light| {
        let object = one(Class::Light(Box::new(chunk)));
        let Kind::Light(light) = object.kind else {
            panic!("no light")
        };
        *light
    };
    let flags = |switches| {
        let light = light(Light {
            switches: Some(switches),
            ..Light::default()
        });
        (light.enabled, light.casts_shadows)
    };
    assert_eq!(
        [flags(0), flags(1), flags(4), flags(0xfb)],
        [(false, true), (true, true), (false, false), (true, true)]
    );
    let default = light(Light::default());
    assert_eq!(
        (default.light_type, default.spot_exponent, default.enabled),
        (LightType::Omnidirectional, 5, true)
    );
    let colour = |colour| {
        light(Light {
            light_colour: Some(colour),
            ..Light::default()
        })
        .colour
        .ambient_diffuse
    };
    let numbers = std::array::from_fn(|at| at as f32 / 16.0);
    let new = Colour {
        values: Some(numbers),
        ..Colour::default()
    };
    assert_eq!(colour(new), [3.0 / 16.0, 4.0 / 16.0, 5.0 / 16.0]);
    let old = Colour {
        old_values: Some(numbers),
        ..Colour::default()
    };
    assert_eq!(colour(old), [0.25; 3]);
    let numbers = std::array::from_fn(|at| at as f32 / 8.0);
    let oldest = Colour {
        oldest_values: Some(numbers),
        ..Colour::default()
    };
    assert_eq!(colour(oldest), [0.5; 3]);
}
