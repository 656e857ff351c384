//! The volume a proximity sensor looks into (spec: sensors 1.1): its numbers, and its edges for display.

use std::f64::consts::TAU;

/// `sim.proximitysensor_*`.
pub const PYRAMID: i64 = 30;
pub const CYLINDER: i64 = 31;
pub const DISC: i64 = 32;
pub const CONE: i64 = 33;
pub const RAY: i64 = 34;

/// Segments of a drawn arc of a whole turn.
const ARC_STEPS: usize = 32;

/// Where a sensor looks: the meaning of most numbers depends on the type. Lengths in metres; pairs are near and far.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    /// From the sensor to where the volume begins.
    pub offset: f64,
    pub range: f64,
    pub x_size: [f64; 2],
    pub y_size: [f64; 2],
    pub radius: [f64; 2],
    /// Opening of discs and cones, rad.
    pub angle: f64,
    /// How much of the inside is left out, 0 to 1.
    pub inside_gap: f64,
    pub faces: [i64; 2],
    pub subdivisions: [i64; 2],
    /// Whatever is nearer keeps the sensor from detecting anything; 0 for no such zone.
    pub close_threshold: f64,
}

type Point = [f64; 3];

impl Volume {
    /// Smallest sizes, m.
    pub const SMALLEST: f64 = 1e-5;

    /// End points of the edges of the volume in the sensor's frame.
    pub fn edges(&self, volume_type: i64) -> Vec<[Point; 2]> {
        match volume_type {
            PYRAMID | CYLINDER => {
                let [near, far] = ends(self, volume_type);
                prism(&near, &far)
            }
            DISC => self.disc(),
            CONE => self.cone(),
            RAY => vec![[[0.0, 0.0, self.offset], [0.0, 0.0, self.offset + self.range]]],
            _ => Vec::new(),
        }
    }

    /// End points of the edges of the part of the volume that is nearer than the threshold.
    pub fn close_edges(&self, volume_type: i64) -> Vec<[Point; 2]> {
        let begin = self.offset + if matches!(volume_type, DISC | CONE) { self.radius[0] } else { 0.0 };
        let depth = (self.close_threshold - begin).min(self.range);
        if self.close_threshold <= 0.0 || depth <= 0.0 {
            return Vec::new();
        }
        let grown = |[near, far]: [f64; 2]| [near, near + (far - near) * depth / self.range.max(Self::SMALLEST)];
        let mut near = self.clone();
        (near.range, near.x_size, near.y_size) = (depth, grown(self.x_size), grown(self.y_size));
        if volume_type == CYLINDER {
            near.radius = grown(self.radius);
        }
        near.edges(volume_type)
    }

    /// A flat sector around z, `y_size` thick.
    fn disc(&self) -> Vec<[Point; 2]> {
        let half = 0.5 * self.y_size[0];
        let side = |y: f64| {
            let arc = |radius: f64| self.arc(radius, |along, across| [across, y, along]);
            let (inner, mut outer) = (arc(self.radius[0]), arc(self.radius[0] + self.range));
            outer.extend(inner.into_iter().rev());
            outer
        };
        prism(&side(-half), &side(half))
    }

    /// A sector of a ball around z, drawn as the outlines of two sections through its axis and its rims.
    fn cone(&self) -> Vec<[Point; 2]> {
        let radii = [self.radius[0], self.radius[0] + self.range];
        let mut edges = Vec::new();
        for turned in [false, true] {
            let place = |along: f64, across: f64| if turned { [0.0, across, along] } else { [across, 0.0, along] };
            let [mut boundary, inner] = [radii[1], radii[0]].map(|radius| self.arc(radius, place));
            boundary.extend(inner.into_iter().rev());
            edges.extend(closed(&boundary));
        }
        for radius in radii {
            let (sin, cos) = (0.5 * self.angle).sin_cos();
            edges.extend(closed(&circle(radius * sin, self.offset + radius * cos, ARC_STEPS as i64)));
        }
        edges
    }

    /// Points of an arc of the opening angle around the point at the offset; `place` makes a point of the coordinates along and
    /// across the axis.
    fn arc(&self, radius: f64, place: impl Fn(f64, f64) -> Point) -> Vec<Point> {
        let steps = ARC_STEPS;
        (0..=steps)
            .map(|i| {
                let (sin, cos) = (self.angle * (i as f64 / steps as f64 - 0.5)).sin_cos();
                place(self.offset + radius * cos, radius * sin)
            })
            .collect()
    }
}

/// The polygons at both ends of a pyramid or a cylinder.
pub(in crate::scene) fn ends(volume: &Volume, volume_type: i64) -> [Vec<Point>; 2] {
    let depths = [volume.offset, volume.offset + volume.range];
    [0, 1].map(|end| match volume_type {
        CYLINDER => circle(volume.radius[end], depths[end], volume.faces[0]),
        _ => rectangle(volume.x_size[end], volume.y_size[end], depths[end]),
    })
}

fn rectangle(x: f64, y: f64, z: f64) -> Vec<Point> {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[i, j]| [0.5 * i * x, 0.5 * j * y, z]).to_vec()
}

/// A polygon of `faces` corners (3 to 512) on a circle around z; x goes through the middle of a side.
fn circle(radius: f64, z: f64, faces: i64) -> Vec<Point> {
    let corners = faces.clamp(3, 512);
    let corner = |i: i64| (TAU * (i as f64 + 0.5) / corners as f64).sin_cos();
    (0..corners).map(corner).map(|(sin, cos)| [radius * cos, radius * sin, z]).collect()
}

/// The edges of a closed polygon.
fn closed(points: &[Point]) -> impl Iterator<Item = [Point; 2]> {
    (0..points.len()).map(|i| [points[i], points[(i + 1) % points.len()]])
}

/// The edges of two polygons of equally many corners and of the lines between them.
fn prism(near: &[Point], far: &[Point]) -> Vec<[Point; 2]> {
    let between = near.iter().zip(far).map(|(&a, &b)| [a, b]);
    closed(near).chain(closed(far)).chain(between).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::sensor::ProximitySensor;

    fn volume(volume_type: i64) -> Volume {
        ProximitySensor::new(volume_type, 0, ProximitySensor::INTEGERS, None).unwrap().volume
    }

    #[test]
    fn edges_reach_from_offset_to_range() {
        let depths = |edges: &[[Point; 2]]| {
            let depths: Vec<f64> = edges.iter().flatten().map(|point| point[2]).collect();
            (depths.iter().copied().fold(f64::MAX, f64::min), depths.iter().copied().fold(f64::MIN, f64::max))
        };
        assert_eq!(volume(RAY).edges(RAY), [[[0.0, 0.0, 0.1], [0.0, 0.0, 0.5]]]);
        assert_eq!(volume(PYRAMID).edges(PYRAMID).len(), 12);
        let (near, far) = depths(&volume(CYLINDER).edges(CYLINDER));
        assert!((near - 0.1).abs() < 1e-12 && (far - 0.3).abs() < 1e-12);
        let (_, far) = depths(&volume(CONE).edges(CONE));
        assert!((far - 0.3).abs() < 1e-12);
    }

    #[test]
    fn only_what_is_near_is_close() {
        let mut ray = volume(RAY);
        assert_eq!(ray.close_edges(RAY), Vec::<[Point; 2]>::new());
        ray.close_threshold = 0.2;
        assert_eq!(ray.close_edges(RAY), [[[0.0, 0.0, 0.1], [0.0, 0.0, 0.2]]]);
    }
}
