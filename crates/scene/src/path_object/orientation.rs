//! Automatic orientation: z along the path, x or y as the bends have it (spec: vrep-era 3.2).

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::{PathAttributes, PathObject};

/// Unit vectors with a larger dot product count as parallel.
const PARALLEL: f64 = 0.99999;

impl PathObject {
    pub(super) fn orient_control_points(&mut self, closed: bool) {
        let places: Vec<_> = self
            .control_points
            .iter()
            .map(|point| point.pose.translation.vector)
            .collect();
        let Some(rotations) = self.rotations(&places, closed) else {
            return;
        };
        for (point, rotation) in self.control_points.iter_mut().zip(rotations) {
            point.pose.rotation = rotation;
        }
    }

    pub(super) fn orient_line(&mut self, closed: bool) {
        let places: Vec<_> = self
            .line
            .iter()
            .map(|point| point.pose.translation.vector)
            .collect();
        let Some(rotations) = self.rotations(&places, closed) else {
            return;
        };
        for (point, rotation) in self.line.iter_mut().zip(rotations) {
            point.pose.rotation = rotation;
        }
    }

    /// None where the orientations are not computed, or the points have no direction.
    fn rotations(&self, places: &[Vector3<f64>], closed: bool) -> Option<Vec<UnitQuaternion<f64>>> {
        if !self
            .attributes
            .contains(PathAttributes::AUTOMATIC_ORIENTATION)
        {
            return None;
        }
        let tangents = Tangents::of(places, closed)?;
        if self.attributes.contains(PathAttributes::KEEP_X_UP) {
            return Some(
                (0..places.len())
                    .map(|at| with_x_up(&tangents.direction(at)))
                    .collect(),
            );
        }
        Some(match tangents.bends() {
            bends if bends.iter().all(Option::is_none) => (0..places.len())
                .map(|at| straight(&tangents.direction(at)))
                .collect(),
            bends => tangents.between_bends(&bends),
        })
    }
}

/// The directions of the path into and out of each point.
struct Tangents {
    into: Vec<Vector3<f64>>,
    out: Vec<Vector3<f64>>,
    /// Length of the path up to each point, and to the start again.
    lengths: Vec<f64>,
    closed: bool,
}

impl Tangents {
    /// None where all points are in one place.
    fn of(places: &[Vector3<f64>], closed: bool) -> Option<Self> {
        let count = places.len();
        let segments: Vec<_> = (0..count)
            .map(|at| places[(at + 1) % count] - places[at])
            .collect();
        let usable = if closed {
            count
        } else {
            count.saturating_sub(1)
        };
        let unit = |segment: &Vector3<f64>| segment.try_normalize(1e-9);
        // Where two points are in one place, the direction is that of the next segment, or else of the one before.
        let out_of = |at: usize| -> Option<Vector3<f64>> {
            let mut later = (0..count)
                .map(|step| (at + step) % count)
                .filter(|&s| s < usable && (closed || s >= at));
            later.find_map(|s| unit(&segments[s]))
        };
        let into = |at: usize| -> Option<Vector3<f64>> {
            let mut earlier = (1..=count)
                .map(|step| (at + count - step) % count)
                .filter(|&s| s < usable && (closed || s < at));
            earlier.find_map(|s| unit(&segments[s]))
        };
        let pairs = (0..count).map(|at| {
            Some((
                into(at).or_else(|| out_of(at))?,
                out_of(at).or_else(|| into(at))?,
            ))
        });
        let (into, out) = pairs.collect::<Option<Vec<_>>>()?.into_iter().unzip();
        let lengths = segments.iter().scan(0.0, |length, segment| {
            let before = *length;
            *length += segment.norm();
            Some(before)
        });
        let mut lengths: Vec<f64> = lengths.collect();
        lengths.push(lengths.last()? + segments.last()?.norm());
        Some(Self {
            into,
            out,
            lengths,
            closed,
        })
    }

    fn direction(&self, at: usize) -> Vector3<f64> {
        (self.into[at] + self.out[at])
            .try_normalize(1e-9)
            .unwrap_or(self.out[at])
    }

    /// The y axis at each point where the path bends.
    fn bends(&self) -> Vec<Option<Vector3<f64>>> {
        let bend = |(into, out): (&Vector3<f64>, &Vector3<f64>)| {
            let turns = into.dot(out).abs() < PARALLEL;
            turns.then(|| (into - out).normalize())
        };
        self.into.iter().zip(&self.out).map(bend).collect()
    }

    /// At bends x is perpendicular to both tangents; elsewhere y changes evenly from bend to bend.
    fn between_bends(&self, bends: &[Option<Vector3<f64>>]) -> Vec<UnitQuaternion<f64>> {
        let count = bends.len();
        let frame = |at: usize| {
            if let Some(y) = bends[at] {
                let x = self.into[at].cross(&self.out[at]).normalize();
                return rotation(&x, &y, &x.cross(&y));
            }
            let y = self.y_between(bends, at, count);
            let z = self.out[at];
            let x = y
                .cross(&z)
                .try_normalize(1e-9)
                .unwrap_or_else(|| any_perpendicular(&z));
            rotation(&x, &z.cross(&x), &z)
        };
        (0..count).map(frame).collect()
    }

    /// The y axis between the bends before and after a point, by distance.
    fn y_between(&self, bends: &[Option<Vector3<f64>>], at: usize, count: usize) -> Vector3<f64> {
        let around = |step: usize| {
            if self.closed {
                Some((at + step) % count)
            } else {
                Some(at + step)
            }
        };
        let after = (1..count).find_map(|step| {
            let other = around(step).filter(|&other| other < count)?;
            Some((bends[other]?, self.distance(at, other)))
        });
        let before = (1..count).find_map(|step| {
            let other = if self.closed {
                (at + count - step) % count
            } else {
                at.checked_sub(step)?
            };
            Some((bends[other]?, self.distance(other, at)))
        });
        match (before, after) {
            (Some((first, from)), Some((second, to))) if from + to > 0.0 => {
                first.lerp(&second, from / (from + to))
            }
            (Some((y, _)), _) | (None, Some((y, _))) => y,
            (None, None) => Vector3::z(),
        }
    }

    /// Length of the path from one point on to another.
    fn distance(&self, from: usize, to: usize) -> f64 {
        let length = self.lengths[to] - self.lengths[from];
        if length >= 0.0 {
            length
        } else {
            length + self.lengths[self.lengths.len() - 1]
        }
    }
}

fn straight(z: &Vector3<f64>) -> UnitQuaternion<f64> {
    let up = if z.z < 0.9 {
        Vector3::z()
    } else {
        Vector3::x()
    };
    let x = up
        .cross(z)
        .try_normalize(1e-9)
        .unwrap_or_else(|| any_perpendicular(z));
    rotation(&x, &z.cross(&x), z)
}

fn with_x_up(z: &Vector3<f64>) -> UnitQuaternion<f64> {
    let y = z
        .cross(&Vector3::z())
        .try_normalize(1e-9)
        .unwrap_or_else(|| any_perpendicular(z));
    rotation(&y.cross(z), &y, z)
}

fn any_perpendicular(direction: &Vector3<f64>) -> Vector3<f64> {
    let other = if direction.x.abs() < 0.5 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    direction.cross(&other).normalize()
}

fn rotation(x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(Matrix3::from_columns(
        &[*x, *y, *z],
    )))
}
