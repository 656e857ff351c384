//! The detection volume of a proximity sensor (spec: sensors 1.1): its numbers, and its edges for display.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// `sim.proximitysensor_*`: the shape of the volume.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VolumeType {
    /// A truncated pyramid.
    Pyramid = 30,
    /// A truncated cone along z, with polygons as its ends.
    Cylinder = 31,
    /// A flat sector around z.
    Disc = 32,
    /// A sector of a ball around z.
    Cone = 33,
    /// A line along z.
    Ray = 34,
}

impl VolumeType {
    const ALL: [Self; 5] = [
        Self::Pyramid,
        Self::Cylinder,
        Self::Disc,
        Self::Cone,
        Self::Ray,
    ];

    /// The type with the number of `sim.proximitysensor_*`.
    pub fn from_code(code: i64) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|volume_type| volume_type.code() == code)
    }

    /// The type of that number; the first or last one for numbers below or above all types.
    pub fn nearest(code: i64) -> Self {
        if code <= Self::Pyramid.code() {
            Self::Pyramid
        } else {
            Self::from_code(code).unwrap_or(Self::Ray)
        }
    }

    /// The number of `sim.proximitysensor_*`.
    pub fn code(self) -> i64 {
        self as i64
    }

    /// Position among the types, from 0: what `sim.proxintparam_volume_type` and the volumes of files contain.
    pub fn index(self) -> i64 {
        self.code() - Self::Pyramid.code()
    }
}

/// Segments of a drawn arc of a whole turn.
const ARC_STEPS: usize = 32;

/// Where a sensor detects: which numbers count depends on the type. Lengths in metres; pairs are near and far end.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    /// The shape of the volume.
    pub volume_type: VolumeType,
    /// Distance from the sensor to where the volume begins.
    pub offset: f64,
    /// Depth of the volume, from where it begins.
    pub range: f64,
    /// Widths of a pyramid.
    pub x_size: [f64; 2],
    /// Heights of a pyramid; the first is the thickness of a disc.
    pub y_size: [f64; 2],
    /// Radii of a cylinder; the first is the inner radius of discs and cones.
    pub radius: [f64; 2],
    /// Opening angle of discs and cones, radians.
    pub angle: f64,
    /// Part of the width that is left out in the middle, 0 to 1.
    pub inside_gap: f64,
    /// Number of facets of round surfaces.
    pub faces: [i64; 2],
    /// Further divisions of the ends of a cone.
    pub subdivisions: [i64; 2],
    /// If an object is nearer than this, the sensor detects nothing; 0 for no such zone.
    pub close_threshold: f64,
}

type Point = [f64; 3];

impl Volume {
    /// Smallest size that scripts can set, metres.
    pub const MIN_SIZE: f64 = 1e-5;

    /// End points of the edges of the volume in the sensor's frame.
    pub fn edges(&self) -> Vec<[Point; 2]> {
        match self.volume_type {
            VolumeType::Pyramid | VolumeType::Cylinder => {
                let [near, far] = self.ends();
                prism(&near, &far)
            }
            VolumeType::Disc => self.disc(),
            VolumeType::Cone => self.cone(),
            VolumeType::Ray => vec![[
                [0.0, 0.0, self.offset],
                [0.0, 0.0, self.offset + self.range],
            ]],
        }
    }

    /// End points of the edges of the part of the volume that is nearer than the threshold.
    pub fn close_edges(&self) -> Vec<[Point; 2]> {
        let is_round = matches!(self.volume_type, VolumeType::Disc | VolumeType::Cone);
        let begin = self.offset + if is_round { self.radius[0] } else { 0.0 };
        let depth = (self.close_threshold - begin).min(self.range);
        if self.close_threshold <= 0.0 || depth <= 0.0 {
            return Vec::new();
        }
        let grown = |[near, far]: [f64; 2]| {
            [
                near,
                near + (far - near) * depth / self.range.max(Self::MIN_SIZE),
            ]
        };
        let mut near = self.clone();
        (near.range, near.x_size, near.y_size) = (depth, grown(self.x_size), grown(self.y_size));
        if self.volume_type == VolumeType::Cylinder {
            near.radius = grown(self.radius);
        }
        near.edges()
    }

    /// The polygons at both ends of a pyramid or a cylinder.
    pub(crate) fn ends(&self) -> [Vec<Point>; 2] {
        let depths = [self.offset, self.offset + self.range];
        [0, 1].map(|end| match self.volume_type {
            VolumeType::Cylinder => circle(self.radius[end], depths[end], self.faces[0]),
            _ => rectangle(self.x_size[end], self.y_size[end], depths[end]),
        })
    }

    /// Corners of a box around the volume in the sensor's frame.
    pub fn extent(&self) -> [Point; 2] {
        let points = match self.volume_type {
            VolumeType::Pyramid | VolumeType::Cylinder => self.ends().concat(),
            VolumeType::Ray => self.edges().concat(),
            VolumeType::Disc | VolumeType::Cone => self.sector_extent().to_vec(),
        };
        let with = |choose: fn(f64, f64) -> f64| {
            points[1..].iter().fold(points[0], |all, point| {
                [0, 1, 2].map(|axis| choose(all[axis], point[axis]))
            })
        };
        [with(f64::min), with(f64::max)]
    }

    fn sector_extent(&self) -> [Point; 2] {
        let half = (0.5 * self.angle).clamp(0.0, PI);
        let radius = (self.radius[0] + self.range).max(0.0);
        let across = if half < FRAC_PI_2 {
            radius * libm::sin(half)
        } else {
            radius
        };
        let thickness = if self.volume_type == VolumeType::Disc {
            0.5 * self.y_size[0]
        } else {
            across
        };
        let behind = (radius * libm::cos(half)).min(0.0);
        [
            [-across, -thickness, self.offset + behind],
            [across, thickness, self.offset + radius],
        ]
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
            let place = |along: f64, across: f64| {
                if turned {
                    [0.0, across, along]
                } else {
                    [across, 0.0, along]
                }
            };
            let [mut boundary, inner] = [radii[1], radii[0]].map(|radius| self.arc(radius, place));
            boundary.extend(inner.into_iter().rev());
            edges.extend(closed(&boundary));
        }
        for radius in radii {
            let (sin, cos) = libm::sincos(0.5 * self.angle);
            edges.extend(closed(&circle(
                radius * sin,
                self.offset + radius * cos,
                ARC_STEPS as i64,
            )));
        }
        edges
    }

    /// Points of an arc of the opening angle around the point at the offset; `place` makes a point of the coordinates along and
    /// across the axis.
    fn arc(&self, radius: f64, place: impl Fn(f64, f64) -> Point) -> Vec<Point> {
        let steps = ARC_STEPS;
        (0..=steps)
            .map(|i| {
                let (sin, cos) = libm::sincos(self.angle * (i as f64 / steps as f64 - 0.5));
                place(self.offset + radius * cos, radius * sin)
            })
            .collect()
    }
}

fn rectangle(x: f64, y: f64, z: f64) -> Vec<Point> {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(|[i, j]| [0.5 * i * x, 0.5 * j * y, z])
        .to_vec()
}

/// A polygon of `faces` corners (3 to 512) on a circle around z; x goes through the middle of a side.
fn circle(radius: f64, z: f64, faces: i64) -> Vec<Point> {
    let corners = faces.clamp(3, 512);
    let corner = |i: i64| libm::sincos(TAU * (i as f64 + 0.5) / corners as f64);
    (0..corners)
        .map(corner)
        .map(|(sin, cos)| [radius * cos, radius * sin, z])
        .collect()
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
    use crate::sensor::{ProximityOptions, ProximitySensor};

    fn volume(volume_type: VolumeType) -> Volume {
        ProximitySensor::new(
            volume_type,
            ProximityOptions::empty(),
            ProximitySensor::INTEGERS,
            None,
        )
        .volume
    }

    #[test]
    fn edges_reach_from_offset_to_range() {
        let depths = |edges: &[[Point; 2]]| {
            let depths: Vec<f64> = edges.iter().flatten().map(|point| point[2]).collect();
            (
                depths.iter().copied().fold(f64::MAX, f64::min),
                depths.iter().copied().fold(f64::MIN, f64::max),
            )
        };
        assert_eq!(
            volume(VolumeType::Ray).edges(),
            [[[0.0, 0.0, 0.1], [0.0, 0.0, 0.5]]]
        );
        assert_eq!(volume(VolumeType::Pyramid).edges().len(), 12);
        let (near, far) = depths(&volume(VolumeType::Cylinder).edges());
        assert!((near - 0.1).abs() < 1e-12 && (far - 0.3).abs() < 1e-12);
        let (_, far) = depths(&volume(VolumeType::Cone).edges());
        assert!((far - 0.3).abs() < 1e-12);
    }

    #[test]
    fn only_what_is_near_is_close() {
        let mut ray = volume(VolumeType::Ray);
        assert_eq!(ray.close_edges(), Vec::<[Point; 2]>::new());
        ray.close_threshold = 0.2;
        assert_eq!(ray.close_edges(), [[[0.0, 0.0, 0.1], [0.0, 0.0, 0.2]]]);
    }
}
