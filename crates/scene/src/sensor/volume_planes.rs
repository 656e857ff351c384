//! The volume of a proximity sensor as convex pieces with holes, bounded by planes (spec: sensors 1.1).
//!
//! Round sides are polygons with the corners on the ideal surface, as files of the original show them: the sector of a ball has
//! `faces` wedges of `subdivisions + 1` bands, a disc `2 * faces` facets on each arc.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Rotation2, Vector2, Vector3};

use super::volume::{Volume, VolumeType};

/// A normal, which points outwards, and its offset d (metres): inside is where `n.p + d <= 0`.
pub type Plane = [f64; 4];

type Vector = Vector3<f64>;

/// A convex part of a volume.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ConvexPiece {
    /// Planes around the piece: its points are inside of all of them.
    pub planes: Vec<Plane>,
    /// Holes: points inside all planes of a hole are outside the piece.
    pub holes: Vec<Vec<Plane>>,
}

impl Volume {
    /// The pieces whose union is the volume, in the frame of the sensor. None for rays and for volumes without extent.
    pub fn pieces(&self) -> Vec<ConvexPiece> {
        let is_sector = self.half_angle() > 0.0 && self.arcs()[1] > 0.0;
        match self.volume_type {
            _ if !self.is_finite() => Vec::new(),
            VolumeType::Pyramid => vec![self.prism_piece()],
            VolumeType::Cylinder if self.radius.iter().any(|radius| *radius > 0.0) => {
                vec![self.prism_piece()]
            }
            VolumeType::Cone if is_sector => Cone::of(self).pieces(),
            VolumeType::Disc if is_sector => self.disc_pieces(),
            _ => Vec::new(),
        }
    }

    /// Whether all of its numbers are finite.
    fn is_finite(&self) -> bool {
        let numbers = [
            self.offset,
            self.range,
            self.angle,
            self.inside_gap,
            self.close_threshold,
        ];
        let pairs = [self.x_size, self.y_size, self.radius];
        numbers
            .iter()
            .chain(pairs.as_flattened())
            .all(|number| number.is_finite())
    }

    /// A pyramid or a cylinder; the gap is as long, and narrower by its factor.
    fn prism_piece(&self) -> ConvexPiece {
        let caps = [
            [0.0, 0.0, -1.0, self.offset],
            [0.0, 0.0, 1.0, -(self.offset + self.range)],
        ];
        let planes = caps.into_iter().chain(self.prism_sides(1.0)).collect();
        let gap = (self.inside_gap > 0.0).then(|| self.prism_sides(self.inside_gap));
        ConvexPiece {
            planes,
            holes: gap.into_iter().collect(),
        }
    }

    fn prism_sides(&self, factor: f64) -> Vec<Plane> {
        let scaled = |[x, y, z]: [f64; 3]| Vector::new(factor * x, factor * y, z);
        let [near, far] = self
            .ends()
            .map(|end| end.into_iter().map(scaled).collect::<Vec<_>>());
        let side = |i: usize| {
            let next = (i + 1) % near.len();
            facet([near[i], near[next], far[next], far[i]], |middle| {
                Vector::new(middle.x, middle.y, 0.0)
            })
        };
        (0..near.len()).filter_map(side).collect()
    }

    fn half_angle(&self) -> f64 {
        (0.5 * self.angle).clamp(0.0, PI)
    }

    /// Radii of the inner and the outer arc.
    fn arcs(&self) -> [f64; 2] {
        [self.radius[0], self.radius[0] + self.range]
    }

    /// A sector is convex up to half a turn; a wider one is two.
    fn disc_pieces(&self) -> Vec<ConvexPiece> {
        let half = self.half_angle();
        let sectors = if half <= FRAC_PI_2 {
            vec![[-half, half]]
        } else {
            vec![[-half, 0.0], [0.0, half]]
        };
        sectors
            .into_iter()
            .map(|sector| self.disc_piece(sector))
            .collect()
    }

    /// The part between two angles from z towards x.
    fn disc_piece(&self, sector: [f64; 2]) -> ConvexPiece {
        let thickness = 0.5 * self.y_size[0];
        let caps = [[0.0, 1.0, 0.0, -thickness], [0.0, -1.0, 0.0, -thickness]];
        let rays = |[from, to]: [f64; 2]| [self.disc_ray(from, -1.0), self.disc_ray(to, 1.0)];
        let share = (sector[1] - sector[0]) / (2.0 * self.half_angle()).max(f64::MIN_POSITIVE);
        let arc = |end: usize| {
            let facets = (2.0 * share * count(self.faces[end], 1) as f64)
                .round()
                .max(1.0) as usize;
            self.disc_arc(self.arcs()[end], sector, facets)
        };
        let planes = caps.into_iter().chain(rays(sector)).chain(arc(1)).collect();
        let near = (self.radius[0] > 0.0).then(|| arc(0));
        let gap = (self.inside_gap > 0.0)
            .then(|| rays(sector.map(|angle| angle * self.inside_gap)).to_vec());
        ConvexPiece {
            planes,
            holes: near.into_iter().chain(gap).collect(),
        }
    }

    /// The plane of a straight side at an angle, with the larger angles (`side` 1) or the smaller ones (-1) outside.
    fn disc_ray(&self, angle: f64, side: f64) -> Plane {
        let (sin, cos) = libm::sincos(angle);
        [side * cos, 0.0, -side * sin, side * sin * self.offset]
    }

    fn disc_arc(&self, radius: f64, [from, to]: [f64; 2], facets: usize) -> Vec<Plane> {
        let step = (to - from) / facets as f64;
        let reach = radius * libm::cos(0.5 * step);
        let plane = |i: usize| {
            let (sin, cos) = libm::sincos(from + step * (i as f64 + 0.5));
            [sin, 0.0, cos, -(reach + cos * self.offset)]
        };
        (0..facets).map(plane).collect()
    }
}

/// A sector of a ball around z.
struct Cone<'a> {
    volume: &'a Volume,
    half: f64,
    faces: usize,
}

impl<'a> Cone<'a> {
    fn of(volume: &'a Volume) -> Self {
        Self {
            volume,
            half: volume.half_angle(),
            faces: count(volume.faces[0], 3),
        }
    }

    /// The sector is convex up to a half ball; a wider one consists of its wedges.
    fn pieces(&self) -> Vec<ConvexPiece> {
        let all: Vec<usize> = (0..self.faces).collect();
        if self.half <= FRAC_PI_2 {
            return vec![self.piece(&all, Vec::new())];
        }
        all.iter()
            .map(|&wedge| self.piece(&[wedge], self.wedge(wedge)))
            .collect()
    }

    /// The wedges together, inside of further planes.
    fn piece(&self, wedges: &[usize], mut planes: Vec<Plane>) -> ConvexPiece {
        let slopes = |half: f64| {
            wedges
                .iter()
                .filter_map(move |&wedge| self.slope(wedge, half))
                .collect::<Vec<_>>()
        };
        let [near, far] = [0, 1].map(|end| {
            let bands = count(self.volume.subdivisions[end] + 1, 1);
            let facet = |&wedge: &usize| {
                (1..=bands).filter_map(move |band| self.facet(end, wedge, [band, bands]))
            };
            wedges.iter().flat_map(facet).collect::<Vec<_>>()
        });
        planes.extend(slopes(self.half));
        planes.extend(far);
        let near = (self.volume.radius[0] > 0.0).then_some(near);
        let gap =
            (self.volume.inside_gap > 0.0).then(|| slopes(self.half * self.volume.inside_gap));
        ConvexPiece {
            planes,
            holes: near.into_iter().chain(gap).collect(),
        }
    }

    /// The direction of a corner around z; x goes through the middle of a face.
    fn azimuth(&self, corner: usize) -> Vector2<f64> {
        Rotation2::new(TAU * (corner as f64 + 0.5) / self.faces as f64) * Vector2::x()
    }

    /// A corner at an angle from z.
    fn corner(&self, radius: f64, angle: f64, corner: usize) -> Vector {
        let across = self.azimuth(corner) * (radius * libm::sin(angle));
        Vector::new(
            across.x,
            across.y,
            self.volume.offset + radius * libm::cos(angle),
        )
    }

    /// The two planes through z around a wedge.
    fn wedge(&self, wedge: usize) -> Vec<Plane> {
        let [from, to] = [self.azimuth(wedge), self.azimuth(wedge + 1)];
        vec![[from.y, -from.x, 0.0, 0.0], [-to.y, to.x, 0.0, 0.0]]
    }

    /// The plane of a wedge through the centre; none where the sector is a whole ball.
    fn slope(&self, wedge: usize, half: f64) -> Option<Plane> {
        let [a, b] = [0, 1].map(|next| self.corner(1.0, half, wedge + next));
        let centre = Vector::new(0.0, 0.0, self.volume.offset);
        // z is inside, however wide the sector is.
        facet([centre, a, b, centre], |_| -Vector::z())
    }

    /// A facet on the near (0) or far (1) end of a wedge: one of so many bands from z outwards.
    fn facet(&self, end: usize, wedge: usize, [band, bands]: [usize; 2]) -> Option<Plane> {
        let radius = self.volume.arcs()[end];
        let at = |band: usize, next: usize| {
            self.corner(radius, self.half * band as f64 / bands as f64, wedge + next)
        };
        let centre = Vector::new(0.0, 0.0, self.volume.offset);
        facet(
            [at(band - 1, 0), at(band - 1, 1), at(band, 1), at(band, 0)],
            |middle| middle - centre,
        )
    }
}

/// The plane of a flat quadrilateral, of which one side may be a point. `outwards` is a direction that leads out at its middle. None
/// without an area.
fn facet([a, b, c, d]: [Vector; 4], outwards: impl FnOnce(Vector) -> Vector) -> Option<Plane> {
    let along = (b - a) + (c - d);
    let across = (d - a) + (c - b);
    let normal = along.cross(&across).try_normalize(0.0)?;
    let middle = 0.25 * (a + b + c + d);
    let normal = if normal.dot(&outwards(middle)) < 0.0 {
        -normal
    } else {
        normal
    };
    Some([normal.x, normal.y, normal.z, -normal.dot(&middle)])
}

/// A number of faces or bands, within what is sensible.
fn count(number: i64, least: i64) -> usize {
    number.clamp(least, 512) as usize
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

    fn contains(pieces: &[ConvexPiece], point: [f64; 3]) -> bool {
        let inside = |planes: &[Plane]| {
            planes
                .iter()
                .all(|[x, y, z, d]| x * point[0] + y * point[1] + z * point[2] + d <= 1e-12)
        };
        pieces
            .iter()
            .any(|piece| inside(&piece.planes) && !piece.holes.iter().any(|hole| inside(hole)))
    }

    fn has(planes: &[Plane], expected: Plane) -> bool {
        planes.iter().any(|plane| {
            plane
                .iter()
                .zip(expected)
                .all(|(a, b)| (a - b).abs() < 2e-5)
        })
    }

    /// Numbers of a file of 4.10.
    #[test]
    fn the_planes_of_a_cone_are_those_of_a_file() {
        let mut cone = volume(VolumeType::Cone);
        (cone.range, cone.radius, cone.angle) = (1.0, [0.005, 0.0], PI / 6.0);
        (cone.faces, cone.subdivisions) = ([8, 1], [0, 2]);
        let [ConvexPiece { planes, holes }] = &cone.pieces()[..] else {
            panic!("one piece")
        };
        assert_eq!((planes.len(), holes.len(), holes[0].len()), (32, 1, 8));
        assert!(
            has(planes, [0.9707, 0.0, -0.2403, 0.0])
                && has(planes, [-0.68639, -0.68639, -0.2403, 0.0])
        );
        assert!(
            has(planes, [0.04721, 0.0, 0.99889, -1.00388])
                && has(planes, [0.0, -0.14107, 0.99, -1.00258])
        );
        assert!(has(planes, [-0.16499, -0.16499, 0.9724, -1.00003]));
        assert!(has(&holes[0], [0.09975, 0.09975, 0.99, -0.00495]));
    }

    #[test]
    fn the_planes_of_a_disc_are_those_of_a_file() {
        let mut disc = volume(VolumeType::Disc);
        (disc.range, disc.radius, disc.angle) = (2.0, [0.01, 0.2], PI / 3.0);
        (disc.faces, disc.y_size) = ([16, 32], [0.05, 0.1]);
        let [ConvexPiece { planes, holes }] = &disc.pieces()[..] else {
            panic!("one piece")
        };
        assert_eq!((planes.len(), holes.len(), holes[0].len()), (68, 1, 32));
        assert!(
            has(planes, [0.00818, 0.0, 0.99997, -2.00993]) && has(planes, [0.0, -1.0, 0.0, -0.025])
        );
        assert!(
            has(planes, [0.86603, 0.0, -0.5, 0.0])
                && has(&holes[0], [-0.01636, 0.0, 0.99987, -0.01])
        );
    }

    #[test]
    fn wide_sectors_contain_what_is_behind() {
        for volume_type in [VolumeType::Cone, VolumeType::Disc] {
            let mut wide = volume(volume_type);
            (wide.angle, wide.offset, wide.radius) = (5.0, 0.5, [0.05, 0.0]);
            let pieces = wide.pieces();
            let at = |angle: f64, distance: f64| {
                [distance * angle.sin(), 0.0, 0.5 + distance * angle.cos()]
            };
            for inside in [0.0, 1.0, -1.0, 2.4, -2.4] {
                assert!(
                    contains(&pieces, at(inside, 0.1)),
                    "{volume_type:?} {inside}"
                );
                assert!(
                    !contains(&pieces, at(inside, 0.04)) && !contains(&pieces, at(inside, 0.3))
                );
            }
            assert!(!contains(&pieces, at(2.6, 0.1)) && !contains(&pieces, at(-2.6, 0.1)));
        }
    }

    #[test]
    fn a_gap_is_the_inner_part() {
        for volume_type in [
            VolumeType::Pyramid,
            VolumeType::Cylinder,
            VolumeType::Cone,
            VolumeType::Disc,
        ] {
            let mut hollow = volume(volume_type);
            (hollow.offset, hollow.range, hollow.radius, hollow.x_size) =
                (0.0, 1.0, [0.5; 2], [1.0; 2]);
            let depth = 0.6;
            assert!(
                contains(&hollow.pieces(), [0.0, 0.0, depth]),
                "{volume_type:?}"
            );
            hollow.inside_gap = 0.5;
            let pieces = hollow.pieces();
            assert!(
                !contains(&pieces, [0.0, 0.0, depth]) && !contains(&pieces, [0.2, 0.0, depth]),
                "{volume_type:?}"
            );
            assert!(
                contains(&pieces, [0.4, 0.0, depth]) && contains(&pieces, [-0.4, 0.0, depth]),
                "{volume_type:?}"
            );
        }
    }

    #[test]
    fn points_inside_are_behind_all_planes() {
        for volume_type in [
            VolumeType::Pyramid,
            VolumeType::Cylinder,
            VolumeType::Cone,
            VolumeType::Disc,
        ] {
            let mut volume = volume(volume_type);
            volume.radius = [0.01, 0.02];
            assert!(
                contains(
                    &volume.pieces(),
                    [0.0, 0.0, volume.offset + 0.5 * volume.range]
                ),
                "{volume_type:?}"
            );
            assert!(!contains(
                &volume.pieces(),
                [0.0, 0.0, volume.offset - 0.01]
            ));
        }
        assert!(volume(VolumeType::Ray).pieces().is_empty());
    }
}
