//! Points in space from depth images, on a grid of directions.

use super::{Rgb, RgbImage, byte, mean};

/// How a sensor sees: along +z, columns towards -x, rows towards +y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Optics {
    /// Distance along z of depth 0, metres.
    pub near: f64,
    /// Distance along z of depth 1, metres.
    pub far: f64,
    /// Extent of the view.
    pub opening: Opening,
}

/// Extent of a sensor's view along the larger side of its image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Opening {
    /// Radians.
    Perspective(f64),
    /// Metres.
    Orthographic(f64),
}

/// The grid on which points are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grid {
    /// Equal steps of the angle.
    Angles,
    /// Equal steps in the image.
    Image,
}

/// A point in the sensor's frame and its distance, metres; and the pixel it comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// In the sensor's frame, metres.
    pub position: [f64; 3],
    /// From the sensor's origin, metres.
    pub distance: f64,
    /// Index of the pixel in the depth image.
    pub pixel: usize,
}

/// The points of a depth image, row by row, `counts` columns and rows.
pub fn coordinates(
    depth: &RgbImage,
    optics: &Optics,
    counts: [usize; 2],
    grid: Grid,
) -> Vec<Point> {
    let sides = sides(depth.size());
    let places = (0..counts[1]).flat_map(|row| (0..counts[0]).map(move |column| (column, row)));
    let points = places.map(|(column, row)| {
        let parts = [part(column, counts[0]), part(row, counts[1])];
        match optics.opening {
            Opening::Orthographic(size) => {
                let pixel = pixel_at(depth, parts);
                let z = optics.depth(depth.pixels[pixel]);
                Point {
                    position: [parts[0] * size * sides[0], parts[1] * size * sides[1], z],
                    distance: z,
                    pixel,
                }
            }
            Opening::Perspective(angle) => {
                let slopes = [0, 1].map(|i| {
                    let edge = sides[i] * libm::tan(angle / 2.0);
                    if grid == Grid::Angles {
                        libm::tan(parts[i] * 2.0 * libm::atan(edge))
                    } else {
                        parts[i] * 2.0 * edge
                    }
                });
                let pixel = pixel_at(
                    depth,
                    [0, 1].map(|i| slopes[i] / (2.0 * sides[i] * libm::tan(angle / 2.0))),
                );
                optics.along(slopes, pixel, depth)
            }
        }
    });
    points.collect()
}

/// The points a scanner of lines takes from a depth image, column by column: `counts` columns and rows, `vertical_angle` from the
/// lowest to the highest row.
pub fn scan_lines(
    depth: &RgbImage,
    optics: &Optics,
    counts: [usize; 2],
    vertical_angle: f64,
) -> Vec<Point> {
    let sides = sides(depth.size());
    let angle = match optics.opening {
        Opening::Perspective(angle) => angle,
        Opening::Orthographic(_) => std::f64::consts::FRAC_PI_3,
    };
    let edges = sides.map(|side| side * libm::tan(angle / 2.0));
    let places = (0..counts[0]).flat_map(|column| (0..counts[1]).map(move |row| (column, row)));
    let points = places.map(|(column, row)| {
        let azimuth = part(column, counts[0]) * 2.0 * libm::atan(edges[0]);
        let elevation = part(row, counts[1]) * vertical_angle;
        let slopes = [
            libm::tan(azimuth),
            libm::tan(elevation) / libm::cos(azimuth),
        ];
        let pixel = pixel_at(
            depth,
            [slopes[0] / (2.0 * edges[0]), slopes[1] / (2.0 * edges[1])],
        );
        optics.along(slopes, pixel, depth)
    });
    points.collect()
}

/// Red, green and blue of the pixels the points come from.
pub fn colours(points: &[Point], image: &RgbImage) -> Vec<u8> {
    points
        .iter()
        .flat_map(|point| image.pixels[point.pixel].map(byte))
        .collect()
}

impl Optics {
    /// Metres along the axis.
    fn depth(&self, pixel: Rgb) -> f64 {
        self.near + mean(pixel) * (self.far - self.near)
    }

    /// The point in a direction of slopes x/z and y/z; none is farther than the far plane.
    fn along(&self, slopes: [f64; 2], pixel: usize, depth: &RgbImage) -> Point {
        let z = self.depth(depth.pixels[pixel]);
        let position = [slopes[0] * z, slopes[1] * z, z];
        let distance = position.iter().map(|x| x * x).sum::<f64>().sqrt();
        if distance > self.far {
            return Point {
                position: position.map(|x| x * self.far / distance),
                distance: self.far,
                pixel,
            };
        }
        Point {
            position,
            distance,
            pixel,
        }
    }
}

/// The sides of an image by the larger one.
fn sides([width, height]: [usize; 2]) -> [f64; 2] {
    let larger = numbers::real(width.max(height));
    [
        numbers::real(width) / larger,
        numbers::real(height) / larger,
    ]
}

/// From -1/2 to 1/2 in equal steps; a single one is in the middle.
fn part(at: usize, count: usize) -> f64 {
    if count < 2 {
        0.0
    } else {
        numbers::real(at) / numbers::real(count - 1) - 0.5
    }
}

/// The pixel at parts of the image from its middle, +x to the left.
fn pixel_at(image: &RgbImage, [x, y]: [f64; 2]) -> usize {
    let [width, height] = [numbers::real(image.width), numbers::real(image.height)];
    let column = numbers::index((0.5 - x) * (width - 0.5));
    let row = numbers::index((0.5 + y) * (height - 0.5));
    row.min(image.height - 1) * image.width + column.min(image.width - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const OPTICS: Optics = Optics {
        near: 0.1,
        far: 10.0,
        opening: Opening::Perspective(std::f64::consts::FRAC_PI_3),
    };

    fn is_near(point: &Point, [x, y, z, d]: [f64; 4]) -> bool {
        let found = [
            point.position[0],
            point.position[1],
            point.position[2],
            point.distance,
        ];
        found
            .iter()
            .zip([x, y, z, d])
            .all(|(a, b)| (a - b).abs() < 1e-6)
    }

    #[test]
    fn a_plane_on_a_grid_of_angles() {
        let plane = RgbImage::uniform([64, 64], [0.5; 3]);
        let points = coordinates(&plane, &OPTICS, [3, 3], Grid::Angles);
        assert!(
            is_near(&points[0], [-2.915619, -2.915619, 5.05, 6.519522]),
            "{:?}",
            points[0]
        );
        assert!(is_near(&points[4], [0.0, 0.0, 5.05, 5.05]));
        let nothing = RgbImage::uniform([64, 64], [1.0; 3]);
        let points = coordinates(&nothing, &OPTICS, [3, 3], Grid::Angles);
        assert!(is_near(&points[3], [-5.0, 0.0, 8.660254, 10.0]));
    }

    #[test]
    fn points_lie_on_the_pixels_they_come_from() {
        let mut image = RgbImage::uniform([8, 4], [0.5; 3]);
        // The upper left corner of the picture.
        image.pixels[3 * 8] = [0.25; 3];
        let points = coordinates(&image, &OPTICS, [2, 2], Grid::Image);
        assert_eq!(
            points.iter().map(|point| point.pixel).collect::<Vec<_>>(),
            [7, 0, 31, 24]
        );
        let [x, y, z] = points[3].position;
        let edge = 30f64.to_radians().tan();
        assert!(
            (z - 2.575).abs() < 1e-12
                && (x - edge * z).abs() < 1e-12
                && (y - edge * z / 2.0).abs() < 1e-12
        );
        assert_eq!(colours(&points[3..], &image), [63, 63, 63]);
    }

    #[test]
    fn an_orthographic_sensor_sees_a_rectangle() {
        let optics = Optics {
            opening: Opening::Orthographic(2.0),
            ..OPTICS
        };
        let points = coordinates(
            &RgbImage::uniform([8, 4], [1.0; 3]),
            &optics,
            [2, 2],
            Grid::Angles,
        );
        assert!(is_near(&points[0], [-1.0, -0.5, 10.0, 10.0]));
    }

    #[test]
    fn lines_are_scanned_column_by_column() {
        let plane = RgbImage::uniform([64, 64], [0.5; 3]);
        let points = scan_lines(&plane, &OPTICS, [3, 2], 0.4);
        let x = -30f64.to_radians().tan() * 5.05;
        let y = 0.2f64.tan() / 30f64.to_radians().cos() * 5.05;
        let d = (x * x + y * y + 5.05 * 5.05).sqrt();
        assert!(is_near(&points[0], [x, -y, 5.05, d]), "{:?}", points[0]);
        assert!(is_near(&points[1], [x, y, 5.05, d]));
        // Beyond the image, the pixels at its border count.
        assert_eq!(scan_lines(&plane, &OPTICS, [1, 3], 3.0)[2].pixel / 64, 63);
    }
}
