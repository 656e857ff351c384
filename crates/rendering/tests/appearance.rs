//! Light, transparency, textures, fog, shadows, in numbers.

mod common;

use std::sync::Arc;

use common::*;
use geometry::Pose;
use nalgebra::UnitQuaternion;
use rendering::{
    Background, Channels, Fog, FogDensity, Image, Instance, Light, LightKind, Material, Mesh,
    Projection, Renderer, Texture, TextureMode, World,
};

fn wall() -> Mesh {
    rectangle(40.0, 40.0, 3.0)
}

/// A picture of instances at depth 3 lit by ambient light only, and its colour in the middle.
fn middle(world: &World) -> [u8; 3] {
    let picture = Renderer::new(1).render(world, &camera(31, 31), Channels::ALL);
    colour_at(&picture, 15, 15)
}

#[test]
fn transparent_surfaces_are_blended_from_back_to_front() {
    let wall = wall();
    let [red, green, blue] =
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Material::unlit);
    let (green, blue) = (
        Material {
            opacity: 0.5,
            ..green
        },
        Material {
            opacity: 0.25,
            ..blue
        },
    );
    let back = instance(&wall, &red, 1);
    let (middle_one, front) = (
        at(instance(&wall, &green, 2), 0.0, 0.0, -1.0),
        at(instance(&wall, &blue, 3), 0.0, 0.0, -2.0),
    );
    for instances in [
        [back, middle_one, front],
        [front, back, middle_one],
        [middle_one, front, back],
    ] {
        let world = World {
            instances: &instances,
            ..World::EMPTY
        };
        assert_eq!(middle(&world), [96, 96, 64]);
        let picture = Renderer::new(1).render(&world, &camera(31, 31), Channels::ALL);
        assert!((id_at(&picture, 3, 3), depth_at(&picture, 3, 3)) == (3, (0.99 / 9.99) as f32));
    }
    let behind = [at(back, 0.0, 0.0, -2.5), middle_one, front];
    assert_eq!(
        middle(&World {
            instances: &behind,
            ..World::EMPTY
        }),
        [255, 0, 0]
    );
}

#[test]
fn of_surfaces_in_one_plane_the_first_is_seen() {
    let (wall, part) = (wall(), rectangle(7.0, 3.0, 3.0));
    let [red, green] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Material::unlit);
    let tilt = Pose::from_parts(
        [0.3, -0.2, 0.5].into(),
        UnitQuaternion::from_euler_angles(0.9, 0.3, 0.1),
    );
    let [part, wall] = [instance(&part, &green, 2), instance(&wall, &red, 1)]
        .map(|it| Instance { pose: tilt, ..it });
    let ids = |instances: &[Instance]| {
        Renderer::new(1)
            .render(
                &World {
                    instances,
                    ..World::EMPTY
                },
                &camera(90, 90),
                Channels::IDS,
            )
            .ids
    };
    let (alone, first, last) = (ids(&[part]), ids(&[part, wall]), ids(&[wall, part]));
    assert!(alone.iter().filter(|id| **id == 2).count() > 100);
    assert!(
        alone
            .iter()
            .zip(&first)
            .all(|(alone, first)| (*alone == 2) == (*first == 2))
    );
    assert!(!last.contains(&2));
}

#[test]
fn lights_have_attenuation_and_cones() {
    let (wall, white) = (
        wall(),
        Material {
            specular: [0.0; 3],
            ..Material::new([1.0; 3])
        },
    );
    let instances = [instance(&wall, &white, 1)];
    let lit = |light: Light| {
        middle(&World {
            instances: &instances,
            lights: &[light],
            ..World::EMPTY
        })[0]
    };
    let omni = Light {
        attenuation: [1.0, 1.0, 0.0],
        ..Light::new(LightKind::Omni, Pose::translation(0.0, 0.0, 2.0))
    };
    assert_eq!(lit(omni), 128);
    let away = Light {
        pose: Pose::translation(0.0, 0.0, 4.0),
        ..omni
    };
    assert_eq!(lit(away), 0);
    // 45 degrees off the axis: the cosine is the root of 1/2, to the power of 2, and once more for the surface.
    let pose = Pose::translation(1.0, 0.0, 2.0);
    let spot = |cutoff: f64| {
        Light::new(
            LightKind::Spot {
                cutoff,
                exponent: 2,
            },
            pose,
        )
    };
    assert_eq!(
        lit(spot(0.8)),
        (0.5f64 * 0.5f64.sqrt() * 255.0).round() as u8
    );
    assert_eq!(lit(spot(0.7)), 0);
}

#[test]
fn highlights_are_between_light_and_viewer() {
    let (wall, shiny) = (
        wall(),
        Material {
            specular: [0.5; 3],
            ..Material::new([0.0; 3])
        },
    );
    let instances = [instance(&wall, &shiny, 1)];
    let lit = |degrees: f64| {
        let pose = Pose::rotation(nalgebra::Vector3::y() * degrees.to_radians());
        let light = Light::new(LightKind::Directional, pose);
        middle(&World {
            instances: &instances,
            lights: &[light],
            ..World::EMPTY
        })[0]
    };
    assert_eq!(lit(0.0), 128);
    // The half-way vector is 5 degrees away from the normal.
    assert_eq!(
        lit(10.0),
        (0.5 * 5f64.to_radians().cos().powi(48) * 255.0).round() as u8
    );
}

#[test]
fn textures_repeat_or_end() {
    let pixels = [[200, 0, 0], [0, 200, 0], [0, 0, 200], [200, 200, 200]].concat();
    let image = Arc::new(Image::new([2, 2], false, &pixels).unwrap());
    assert!(
        Image::new([2, 2], true, &pixels).is_none() && Image::new([0, 2], false, &[]).is_none()
    );
    // The picture shows -1 to 2 along both axes of the image; +X is on the left.
    let vertices = [
        [1.5, -1.5, 3.0],
        [-1.5, -1.5, 3.0],
        [-1.5, 1.5, 3.0],
        [1.5, 1.5, 3.0],
    ];
    let uv = [
        [-1.0, -1.0],
        [2.0, -1.0],
        [2.0, 2.0],
        [-1.0, -1.0],
        [2.0, 2.0],
        [-1.0, 2.0],
    ];
    let square = Mesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]], &[], &uv).unwrap();
    let mut camera = camera(60, 60);
    camera.projection = Projection::Orthographic { size: 3.0 };
    let picture = |repeat: bool, mode: TextureMode| {
        let texture = Texture {
            repeat: [repeat; 2],
            interpolate: false,
            mode,
            ..Texture::new(image.clone())
        };
        let material = Material {
            texture: Some(texture),
            ..Material::unlit([1.0, 0.5, 1.0])
        };
        Renderer::new(1).render(
            &World {
                instances: &[instance(&square, &material, 1)],
                ..World::EMPTY
            },
            &camera,
            Channels::ALL,
        )
    };
    let repeated = picture(true, TextureMode::Modulate);
    for (x, y) in [(2, 2), (22, 22), (42, 2), (2, 42)] {
        assert_eq!(colour_at(&repeated, x, y), [200, 0, 0]);
        assert_eq!(colour_at(&repeated, x + 10, y), [0, 100, 0]);
        assert_eq!(colour_at(&repeated, x, y + 10), [0, 0, 200]);
    }
    let once = picture(false, TextureMode::Decal);
    assert_eq!(
        (colour_at(&once, 2, 2), colour_at(&once, 58, 58)),
        ([200, 0, 0], [200; 3])
    );
    assert_eq!(
        (colour_at(&once, 58, 22), colour_at(&once, 2, 58)),
        ([0, 200, 0], [0, 0, 200])
    );
}

#[test]
fn textures_are_correct_in_perspective() {
    // A floor whose texture is a gradient along the view: the colour is that of the place.
    let ramp: Vec<u8> = (0..=255).flat_map(|i| [i, i, i]).collect();
    let texture = Texture {
        repeat: [false; 2],
        ..Texture::new(Arc::new(Image::new([1, 256], false, &ramp).unwrap()))
    };
    let material = Material {
        texture: Some(texture),
        ..Material::unlit([1.0; 3])
    };
    let vertices = [
        [5.0, -1.0, 0.5],
        [-5.0, -1.0, 0.5],
        [-5.0, -1.0, 10.5],
        [5.0, -1.0, 10.5],
    ];
    let uv = [
        [0.0, 0.0],
        [0.0, 0.0],
        [0.0, 1.0],
        [0.0, 0.0],
        [0.0, 1.0],
        [0.0, 1.0],
    ];
    let floor = Mesh::new(&vertices, &[[0, 1, 2], [0, 2, 3]], &[], &uv).unwrap();
    let picture = render(&[instance(&floor, &material, 1)], &camera(64, 64));
    for y in 0..28 {
        let z = f64::from(depth_at(&picture, 20, y)) * 9.99 + 0.01;
        if z < 9.9 {
            let expected = (z - 0.5) / 10.0 * 256.0 - 0.5;
            assert!(
                (f64::from(colour_at(&picture, 20, y)[0]) - expected).abs() < 1.0,
                "{y} {z}"
            );
        }
    }
}

#[test]
fn fog_grows_with_depth() {
    let (wall, white) = (wall(), Material::unlit([1.0; 3]));
    let instances = [instance(&wall, &white, 1)];
    let seen = |density: FogDensity| {
        let fog = Some(Fog {
            density,
            colour: [0.0, 0.0, 1.0],
        });
        middle(&World {
            instances: &instances,
            fog,
            background: Background::plain([1.0, 0.0, 0.0]),
            ..World::EMPTY
        })
    };
    assert_eq!(
        seen(FogDensity::Linear {
            start: 2.0,
            end: 6.0
        }),
        [191, 191, 255]
    );
    assert_eq!(
        seen(FogDensity::Linear {
            start: 1.0,
            end: 2.0
        }),
        [0, 0, 255]
    );
    assert_eq!(seen(FogDensity::Exponential(0.5)), [57, 57, 255]);
    assert_eq!(seen(FogDensity::ExponentialSquared(0.5)), [27, 27, 255]);
}

#[test]
fn the_background_is_a_gradient() {
    let background = Background {
        bottom: [0.0; 3],
        top: [1.0, 0.5, 0.0],
    };
    let picture = Renderer::new(1).render(
        &World {
            background,
            ..World::EMPTY
        },
        &camera(3, 100),
        Channels::ALL,
    );
    assert_eq!(
        (colour_at(&picture, 1, 0), colour_at(&picture, 2, 99)),
        ([1, 1, 0], [254, 127, 0])
    );
}

#[test]
fn shadows_lie_where_light_does_not_reach() {
    let (floor, plate) = (cuboid([10.0, 10.0, 0.1]), cuboid([0.5, 0.5, 0.02]));
    let white = Material {
        specular: [0.0; 3],
        ..Material::new([1.0; 3])
    };
    let glass = Material {
        opacity: 0.5,
        ..white.clone()
    };
    // From above: a plate half-way between the floor and the light.
    let mut camera = camera(100, 100);
    camera.pose = Pose::from_parts(
        nalgebra::Vector3::new(0.0, 0.0, 5.0).into(),
        nalgebra::UnitQuaternion::from_axis_angle(
            &nalgebra::Vector3::x_axis(),
            std::f64::consts::PI,
        ),
    );
    camera.projection = Projection::Orthographic { size: 2.0 };
    let dark = |light: Light, material: &Material, shadows: bool| {
        let floor = at(instance(&floor, &white, 1), 0.0, 0.0, -0.05);
        let instances = [floor, at(instance(&plate, material, 2), 0.0, 0.0, 0.5)];
        let world = World {
            instances: &instances,
            lights: &[light],
            shadows,
            ..World::EMPTY
        };
        let picture = Renderer::new(2).render(&world, &camera, Channels::ALL);
        let floor = picture
            .ids
            .iter()
            .zip(picture.colour.chunks(3))
            .filter(|(id, _)| **id == 1);
        (
            floor.filter(|(_, colour)| colour[0] == 0).count(),
            count(&picture, 2),
        )
    };
    let omni = Light::new(LightKind::Omni, Pose::translation(0.0, 0.0, 1.0));
    let (shadow, plate_pixels) = dark(omni, &white, true);
    // The plate covers 25 x 25 pixels; its upper side is 0.49 below the light, its shadow 1 / 0.49 times as large.
    let side = 25.0 / 0.49f64;
    assert_eq!(plate_pixels, 625);
    assert!(
        (shadow as f64 - (side * side - 625.0)).abs() < 150.0,
        "{shadow} {side}"
    );
    assert_eq!(dark(omni, &white, false).0, 0);
    assert_eq!(
        dark(
            Light {
                casts_shadows: false,
                ..omni
            },
            &white,
            true
        )
        .0,
        0
    );
    assert_eq!(dark(omni, &glass, true).0, 0);
    // Light that shines along the view: the shadow is hidden behind the plate.
    let sun = Light::new(LightKind::Directional, camera.pose);
    assert_eq!(dark(sun, &white, true), (0, 625));
    // And 45 degrees off: the shadow is moved by its height.
    let sun = Light::new(
        LightKind::Directional,
        camera.pose * Pose::rotation(nalgebra::Vector3::y() * 0.25 * std::f64::consts::PI),
    );
    let moved = dark(sun, &white, true).0;
    assert!((550..=675).contains(&moved), "{moved}");
}

#[test]
fn many_transparent_layers_take_their_time_but_not_its_square() {
    let (wall, glass) = (
        wall(),
        Material {
            opacity: 0.01,
            ..Material::unlit([1.0; 3])
        },
    );
    let instances: Vec<_> = (0..3000)
        .map(|i| at(instance(&wall, &glass, 1), 0.0, 0.0, f64::from(i) * 1e-3))
        .collect();
    assert_eq!(
        middle(&World {
            instances: &instances,
            ..World::EMPTY
        }),
        [255; 3]
    );
    // The lower half of them only: 1 - 0.99^150.
    assert_eq!(
        middle(&World {
            instances: &instances[..150],
            ..World::EMPTY
        }),
        [199; 3]
    );
}
