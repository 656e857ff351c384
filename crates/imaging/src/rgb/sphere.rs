//! A picture of all directions, composed from six square pictures that look along the axes.

use std::f64::consts::{PI, TAU};

/// The faces of the cube, in the order of the sensors: front, top, back, bottom, left, right.
pub const FACES: usize = 6;

/// The limits of the horizontal and the vertical angle, rad.
const MIN_ANGLE: f64 = 5.0 / 180.0 * PI;
const MAX_ANGLES: [f64; 2] = [TAU, PI];

/// Where a pixel of the sphere comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// Index of the face of the cube, below [`FACES`].
    pub face: usize,
    /// Index in the face's picture.
    pub pixel: usize,
    /// Length of the ray for a depth of 1 along the face's axis.
    pub stretch: f64,
}

/// The sources of all pixels of a picture of `size`, which spans `angles`, from square pictures of `resolution`.
pub fn sources(size: [usize; 2], angles: [f64; 2], resolution: usize) -> Vec<Source> {
    let angles = [0, 1].map(|i| angles[i].max(MIN_ANGLE).min(MAX_ANGLES[i]));
    let angle = |at: usize, i: usize| {
        -angles[i] / 2.0
            + numbers::real(at) * angles[i] / numbers::real(size[i].saturating_sub(1).max(1))
    };
    let places = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (column, row)));
    places
        .map(|(column, row)| source(angle(column, 0), angle(row, 1), resolution))
        .collect()
}

fn source(azimuth: f64, elevation: f64, resolution: usize) -> Source {
    let [x, y, z] = [
        libm::cos(azimuth) * libm::cos(elevation),
        libm::sin(azimuth) * libm::cos(elevation),
        libm::sin(elevation),
    ];
    let largest = x.abs().max(y.abs()).max(z.abs());
    let [x, y, z] = [x / largest, y / largest, z / largest];
    let (face, u, v) = if x == 1.0 {
        (0, -y, z)
    } else if z == 1.0 {
        (1, -y, -x)
    } else if x == -1.0 {
        (2, -y, -z)
    } else if z == -1.0 {
        (3, -y, x)
    } else if y > 0.0 {
        (4, x, z)
    } else {
        (5, -x, z)
    };
    let index = |part: f64| {
        numbers::index((part + 1.0) / 2.0 * numbers::real(resolution) - 0.5)
            .min(resolution.saturating_sub(1))
    };
    Source {
        face,
        pixel: index(v) * resolution + index(u),
        stretch: (1.0 + u * u).sqrt() * (1.0 + v * v).sqrt(),
    }
}

/// A depth along the axis as length of the ray, both normalised between the planes.
pub fn ray_depth(depth: f32, stretch: f64, [near, far]: [f64; 2]) -> f32 {
    let metres = (near + f64::from(depth) * (far - near)) * stretch;
    numbers::single(((metres - near) / (far - near)).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_lie_on_faces() {
        let faces: Vec<usize> = sources([9, 3], [TAU, PI], 10)
            .iter()
            .map(|source| source.face)
            .collect();
        // The lowest row looks down, the middle one around from back over right, front and left to back, the highest one up.
        assert_eq!(faces[..9], [3; 9]);
        assert_eq!(
            [faces[9], faces[11], faces[13], faces[15], faces[17]],
            [2, 5, 0, 4, 2]
        );
        assert_eq!(faces[18..], [1; 9]);
    }

    #[test]
    fn the_middle_of_the_front_is_straight_ahead() {
        let middle = sources([3, 3], [0.2, 0.2], 11)[4];
        assert_eq!(
            middle,
            Source {
                face: 0,
                pixel: 5 * 11 + 5,
                stretch: 1.0
            }
        );
        let corner = source(PI / 4.0, 0.0, 10);
        assert!((corner.stretch - 2f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn angles_are_limited_and_single_pixels_allowed() {
        assert_eq!(sources([1, 1], [0.0, f64::NAN], 1).len(), 1);
        assert_eq!(sources([5, 5], [1e9, -1e9], 7).len(), 25);
    }

    #[test]
    fn depths_become_longer() {
        assert_eq!(ray_depth(0.5, 1.0, [0.0, 2.0]), 0.5);
        assert_eq!(ray_depth(0.5, 3.0, [0.0, 2.0]), 1.0);
    }
}
