//! Colours in their three models.

use super::{object, one_of};
use crate::ttt::chunks::{Colour, Dummy};
use crate::ttt::tree::Class;

/// What becomes of the colour of a dummy of that format.
fn colour(serialization: i32, colour: Colour) -> scene::appearance::colour::Colour {
    let dummy = Dummy {
        colour: Some(colour),
        ..Dummy::default()
    };
    one_of(
        30_102,
        serialization,
        object(1, -1, Class::Dummy(Box::new(dummy))),
    )
    .colour
}

#[track_caller]
fn near(found: [f32; 3], expected: [f32; 3]) {
    let is_near = |(a, b): (&f32, &f32)| (a - b).abs() < 1e-6;
    assert!(
        found.iter().zip(&expected).all(is_near),
        "{found:?} is not {expected:?}"
    );
}

#[test]
fn ambient_and_diffuse_light_were_apart() {
    let mut values = [0.0; 15];
    values[..6].copy_from_slice(&[0.25, 0.5, 0.125, 0.1, 0.2, 0.3]);
    values[6..].copy_from_slice(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]);
    let old = colour(
        18,
        Colour {
            old_values: Some(values),
            ..Colour::default()
        },
    );
    // (c + d / 2) / 0.85, d the mean of the diffuse light.
    near(old.ambient_diffuse, [0.35 / 0.85, 0.6 / 0.85, 0.225 / 0.85]);
    assert_eq!(
        (old.specular, old.emission),
        ([0.1, 0.2, 0.3], [0.4, 0.5, 0.6])
    );
    assert_eq!(old.auxiliary, [0.7, 0.8, 0.9]);
    let mut values = [0.0; 12];
    values[..6].copy_from_slice(&[0.75, 1.0, 0.5, 0.0, 0.6, 0.6]);
    values[9..].copy_from_slice(&[0.4, 0.5, 0.6]);
    let oldest = colour(
        18,
        Colour {
            oldest_values: Some(values),
            ..Colour::default()
        },
    );
    // Divided by the largest where that is above one.
    near(oldest.ambient_diffuse, [0.95 / 1.2, 1.0, 0.7 / 1.2]);
    assert_eq!(oldest.emission, [0.4, 0.5, 0.6]);
}

#[test]
fn colours_of_sensors_were_meant_brighter() {
    let bright = |serialization, rgb: [f32; 3]| {
        let mut values = [0.0; 15];
        values[..3].copy_from_slice(&rgb);
        let chunk = Colour {
            values: Some(values),
            ..Colour::default()
        };
        colour(serialization, chunk).ambient_diffuse
    };
    assert_eq!(bright(17, [0.5, 0.25, 0.0]), [0.5, 0.25, 0.0]);
    near(bright(16, [0.5, 0.25, 0.0]), [0.75, 0.375, 0.0]);
    near(bright(16, [0.8, 0.4, 0.0]), [1.0, 0.5, 0.0]);
    near(bright(16, [1.5, 0.5, 0.0]), [1.5, 0.5, 0.0]);
}

#[test]
fn translucent_colours() {
    let opacity = |flags, opacity| {
        colour(
            25,
            Colour {
                opacity,
                flags,
                ..Colour::default()
            },
        )
        .opacity
    };
    assert_eq!(
        [opacity(Some(0xfb), Some(0.25)), opacity(Some(0), None)],
        [0.25, 0.5]
    );
    assert_eq!(
        [opacity(Some(4), Some(0.25)), opacity(None, Some(0.25))],
        [1.0; 2]
    );
}
