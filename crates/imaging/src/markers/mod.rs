//! Square markers: black squares with bits, which have a number and an orientation.
//!
//! Found as in Garrido-Jurado et al., "Automatic generation and detection of highly reliable fiducial markers under occlusion" (2014):
//! an adaptive threshold, outlines of dark regions, those that are quadrilaterals, their bits by a homography, and the dictionary.

mod bits;
mod candidates;
mod contours;
mod dictionary;

pub use dictionary::Dictionary;

use crate::matrix::{Depth, Matrix, MatrixResult};
use candidates::candidates;

/// Corners in the image, clockwise: column and row.
pub type Quad = [[f64; 2]; 4];

/// A marker in an image. The corners begin with its upper left one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marker {
    /// Number in the dictionary.
    pub id: usize,
    /// Corners in the image.
    pub corners: Quad,
}

/// Markers found in an image.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Detection {
    /// The markers of the dictionary.
    pub markers: Vec<Marker>,
    /// Quadrilaterals that are no markers of the dictionary.
    pub rejected: Vec<Quad>,
}

impl Dictionary {
    /// Finds the markers in an image of bytes with one, three or four channels, of which blue is the first.
    ///
    /// # Errors
    /// When it is another one.
    pub fn detect(&self, image: &Matrix) -> MatrixResult<Detection> {
        image.require(image.format().depth == Depth::Byte, "detection of markers")?;
        let grey = match image.format().channels {
            1 => image.clone(),
            _ => image.swapped()?.grey_from_rgb()?,
        };
        let mut detection = Detection::default();
        for quad in candidates(&grey) {
            match bits::read(&grey, &quad, self.side()).and_then(|bits| self.identify(&bits)) {
                // The outline begins at any of the corners.
                Some((id, turns)) => {
                    let corners = [0, 1, 2, 3].map(|corner| quad[(corner + turns) % 4]);
                    detection.markers.push(Marker { id, corners });
                }
                None => detection.rejected.push(quad),
            }
        }
        Ok(detection)
    }
}

#[cfg(test)]
mod tests {
    use test_support::random::Random;

    use super::bits::Homography;
    use super::*;
    use crate::matrix::PixelFormat;

    /// A picture of a marker on grey paper with a white margin; corners are those of its black border.
    fn scene(id: usize, corners: &Quad, size: [usize; 2]) -> Matrix {
        let marker = Dictionary::aruco_original().draw(id, 280, 1).unwrap();
        let to_marker = Homography::onto_unit_square(corners).unwrap();
        let mut image = Matrix::new(size, PixelFormat::new(Depth::Byte, 1), 150.0).unwrap();
        let brightness = |x: f64, y: f64| {
            let [u, v] = to_marker.apply([x, y]);
            if (0.0..1.0).contains(&u) && (0.0..1.0).contains(&v) {
                return 20.0
                    + 0.8
                        * marker
                            .value((v * 280.0) as usize * 280 + (u * 280.0) as usize)
                            .unwrap();
            }
            if (-0.2..1.2).contains(&u) && (-0.2..1.2).contains(&v) {
                230.0
            } else {
                150.0
            }
        };
        for at in 0..size[0] * size[1] {
            let (x, y) = ((at % size[0]) as f64, (at / size[0]) as f64);
            // Four samples for each pixel.
            let samples = [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]];
            image.set_value(
                at,
                samples
                    .iter()
                    .map(|[dx, dy]| brightness(x + dx, y + dy))
                    .sum::<f64>()
                    / 4.0,
            );
        }
        image
    }

    fn assert_found(id: usize, corners: Quad) {
        let found = Dictionary::aruco_original()
            .detect(&scene(id, &corners, [200, 160]))
            .unwrap();
        assert_eq!(
            found
                .markers
                .iter()
                .map(|marker| marker.id)
                .collect::<Vec<_>>(),
            [id],
            "{found:?}"
        );
        for (found, expected) in found.markers[0].corners.iter().zip(&corners) {
            let error = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            assert!(error < 1.5, "{id}: {found:?} {expected:?}");
        }
    }

    #[test]
    fn markers_are_found_wherever_they_are() {
        let upright = [[40.0, 30.0], [120.0, 30.0], [120.0, 110.0], [40.0, 110.0]];
        let turned = [[120.0, 30.0], [120.0, 110.0], [40.0, 110.0], [40.0, 30.0]];
        let slanted = [[60.0, 20.0], [150.0, 45.0], [130.0, 130.0], [35.0, 115.0]];
        let tilted = [[60.0, 40.0], [140.0, 30.0], [160.0, 130.0], [30.0, 110.0]];
        for (id, corners) in [
            (0, upright),
            (17, upright),
            (1023, turned),
            (372, slanted),
            (5, tilted),
            (800, tilted),
        ] {
            assert_found(id, corners);
        }
    }

    #[test]
    fn other_squares_are_rejected() {
        let corners = [[40.0, 30.0], [120.0, 30.0], [120.0, 110.0], [40.0, 110.0]];
        let mut image = scene(0, &corners, [200, 160]);
        // A white middle: no row is one of a marker.
        for at in (60..100).flat_map(|row| (55..105).map(move |column| row * 200 + column)) {
            image.set_value(at, 230.0);
        }
        let found = Dictionary::aruco_original().detect(&image).unwrap();
        assert!(
            found.markers.is_empty() && !found.rejected.is_empty(),
            "{found:?}"
        );
    }

    #[test]
    fn any_image_is_searched() {
        let dictionary = Dictionary::aruco_original();
        for (size, channels) in [([1, 1], 1), ([3, 2], 3), ([64, 1], 4), ([30, 30], 1)] {
            let mut random = Random::new(7);
            let mut image =
                Matrix::new(size, PixelFormat::new(Depth::Byte, channels), 0.0).unwrap();
            for at in 0..size[0] * size[1] * channels {
                image.set_value(at, f64::from(random.byte()));
            }
            assert!(dictionary.detect(&image).unwrap().markers.is_empty());
        }
        let floats = Matrix::new([9, 9], PixelFormat::new(Depth::Float, 1), 0.0).unwrap();
        assert!(dictionary.detect(&floats).is_err());
    }
}
