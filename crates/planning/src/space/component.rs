//! One component of a space.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::dubins;
use crate::Random;

/// The least and the largest value of each coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    /// The least values.
    pub low: Vec<f64>,
    /// The largest values.
    pub high: Vec<f64>,
}

impl Bounds {
    /// The bounds of coordinates of which each has a least and a largest value.
    pub fn new(low: Vec<f64>, high: Vec<f64>) -> Self {
        Self { low, high }
    }

    fn diagonal(&self) -> f64 {
        self.low
            .iter()
            .zip(&self.high)
            .map(|(low, high)| (high - low) * (high - low))
            .sum::<f64>()
            .sqrt()
    }

    fn pairs(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.low.iter().copied().zip(self.high.iter().copied())
    }
}

/// A component. Distances of two parts are added, those of angles with half their weight.
#[derive(Debug, Clone, PartialEq)]
pub enum Component {
    /// A point: a position, a joint with limits.
    Real(Bounds),
    /// An angle from -π to π, without π: a joint without limits.
    Angle,
    /// A rotation as a unit quaternion x, y, z, w. The distance is half the angle between two.
    Rotation,
    /// A place in the plane and an angle.
    Plane(Bounds),
    /// A place in space and a rotation.
    Space(Bounds),
    /// A car that drives forwards and turns with a least radius. The distance is the length of the shortest curve; if it is `symmetric`, also
    /// of the way back.
    Dubins {
        /// Of the position.
        bounds: Bounds,
        /// Radius of the tightest turn.
        radius: f64,
        /// Whether the way back may be taken as well.
        symmetric: bool,
    },
}

/// How much an angle counts beside a position.
const ANGLE_WEIGHT: f64 = 0.5;

/// How far a quaternion may be from length 1.
const UNIT: f64 = 1e-9;

impl Component {
    /// Numbers of a state.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Real(bounds) => bounds.low.len(),
            Self::Angle => 1,
            Self::Rotation => 4,
            Self::Plane(_) | Self::Dubins { .. } => 3,
            Self::Space(_) => 7,
        }
    }

    /// The largest distance.
    pub fn extent(&self) -> f64 {
        match self {
            Self::Real(bounds) => bounds.diagonal(),
            Self::Angle => PI,
            Self::Rotation => FRAC_PI_2,
            Self::Plane(bounds) | Self::Dubins { bounds, .. } => {
                bounds.diagonal() + ANGLE_WEIGHT * PI
            }
            Self::Space(bounds) => bounds.diagonal() + FRAC_PI_2,
        }
    }

    /// The distance of two states.
    pub fn distance(&self, from: &[f64], to: &[f64]) -> f64 {
        match self {
            Self::Real(_) => euclidean(from, to),
            Self::Angle => arc(from[0], to[0]).abs(),
            Self::Rotation => half_angle(from, to),
            Self::Plane(_) => {
                euclidean(&from[..2], &to[..2]) + ANGLE_WEIGHT * arc(from[2], to[2]).abs()
            }
            Self::Space(_) => euclidean(&from[..3], &to[..3]) + half_angle(&from[3..], &to[3..]),
            Self::Dubins {
                radius, symmetric, ..
            } => dubins::curve(from, to, *radius, *symmetric).length(),
        }
    }

    /// Adds the state at `part` of the way to `out`.
    pub fn interpolate(&self, from: &[f64], to: &[f64], part: f64, out: &mut Vec<f64>) {
        match self {
            Self::Real(_) => linear(from, to, part, out),
            Self::Angle => out.push(wrapped(from[0] + part * arc(from[0], to[0]))),
            Self::Rotation => slerp(from, to, part, out),
            Self::Plane(_) => {
                linear(&from[..2], &to[..2], part, out);
                out.push(wrapped(from[2] + part * arc(from[2], to[2])));
            }
            Self::Space(_) => {
                linear(&from[..3], &to[..3], part, out);
                slerp(&from[3..], &to[3..], part, out);
            }
            Self::Dubins {
                radius, symmetric, ..
            } => {
                out.extend(dubins::curve(from, to, *radius, *symmetric).state_at(part));
            }
        }
    }

    /// Adds a state within the bounds to `out`.
    pub fn sample(&self, random: &mut dyn Random, out: &mut Vec<f64>) {
        match self {
            Self::Real(bounds) => {
                out.extend(bounds.pairs().map(|(low, high)| random.between(low, high)));
            }
            Self::Angle => out.push(random.between(-PI, PI)),
            Self::Rotation => out.extend(rotation(random)),
            Self::Plane(bounds) | Self::Dubins { bounds, .. } => {
                out.extend(bounds.pairs().map(|(low, high)| random.between(low, high)));
                out.push(random.between(-PI, PI));
            }
            Self::Space(bounds) => {
                out.extend(bounds.pairs().map(|(low, high)| random.between(low, high)));
                out.extend(rotation(random));
            }
        }
    }

    /// Adds a state within the bounds and about `distance` from another at most to `out`.
    pub fn sample_near(
        &self,
        random: &mut dyn Random,
        near: &[f64],
        distance: f64,
        out: &mut Vec<f64>,
    ) {
        let around = |random: &mut dyn Random, bounds: &Bounds, out: &mut Vec<f64>| {
            for ((low, high), &centre) in bounds.pairs().zip(near) {
                out.push(random.between(
                    low.max(centre - distance).min(high),
                    high.min(centre + distance).max(low),
                ));
            }
        };
        match self {
            Self::Real(bounds) => around(random, bounds, out),
            Self::Angle => out.push(wrapped(
                random.between(near[0] - distance, near[0] + distance),
            )),
            Self::Rotation => out.extend(rotation_near(random, near, distance)),
            Self::Plane(bounds) | Self::Dubins { bounds, .. } => {
                around(random, bounds, out);
                out.push(wrapped(
                    random.between(near[2] - distance, near[2] + distance),
                ));
            }
            Self::Space(bounds) => {
                around(random, bounds, out);
                out.extend(rotation_near(random, &near[3..], distance));
            }
        }
    }

    /// Whether a state lies within the bounds, angles from -π to below π, and quaternions have length 1.
    pub fn is_within_bounds(&self, state: &[f64]) -> bool {
        let is_inside = |bounds: &Bounds| {
            bounds
                .pairs()
                .zip(state)
                .all(|((low, high), x)| (low..=high).contains(x))
        };
        let is_angle = |angle: f64| (-PI..PI).contains(&angle);
        let is_unit =
            |q: &[f64]| (q.iter().map(|part| part * part).sum::<f64>().sqrt() - 1.0).abs() <= UNIT;
        match self {
            Self::Real(bounds) => is_inside(bounds),
            Self::Angle => is_angle(state[0]),
            Self::Rotation => is_unit(state),
            Self::Plane(bounds) | Self::Dubins { bounds, .. } => {
                is_inside(bounds) && is_angle(state[2])
            }
            Self::Space(bounds) => is_inside(bounds) && is_unit(&state[3..]),
        }
    }

    /// Clamps positions, wraps angles and normalises quaternions.
    pub fn enforce_bounds(&self, state: &mut [f64]) {
        let clamp = |bounds: &Bounds, state: &mut [f64]| {
            bounds
                .pairs()
                .zip(state)
                .for_each(|((low, high), x)| *x = x.min(high).max(low));
        };
        match self {
            Self::Real(bounds) => clamp(bounds, state),
            Self::Angle => state[0] = wrapped(state[0]),
            Self::Rotation => normalise(state),
            Self::Plane(bounds) | Self::Dubins { bounds, .. } => {
                clamp(bounds, state);
                state[2] = wrapped(state[2]);
            }
            Self::Space(bounds) => {
                clamp(bounds, state);
                normalise(&mut state[3..]);
            }
        }
    }
}

fn euclidean(from: &[f64], to: &[f64]) -> f64 {
    from.iter()
        .zip(to)
        .map(|(a, b)| (a - b) * (a - b))
        .sum::<f64>()
        .sqrt()
}

fn linear(from: &[f64], to: &[f64], part: f64, out: &mut Vec<f64>) {
    out.extend(from.iter().zip(to).map(|(a, b)| a + part * (b - a)));
}

/// An angle from -π to π, without π.
pub(super) fn wrapped(angle: f64) -> f64 {
    let turned = (angle + PI).rem_euclid(TAU) - PI;
    if turned >= PI { -PI } else { turned }
}

/// The shortest way from one angle to another.
fn arc(from: f64, to: f64) -> f64 {
    wrapped(to - from)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn half_angle(from: &[f64], to: &[f64]) -> f64 {
    libm::acos(dot(from, to).abs().min(1.0))
}

fn normalise(quaternion: &mut [f64]) {
    let length = dot(quaternion, quaternion).sqrt();
    if length > UNIT && length.is_finite() {
        quaternion.iter_mut().for_each(|part| *part /= length);
    } else {
        quaternion.copy_from_slice(&[0.0, 0.0, 0.0, 1.0]);
    }
}

fn slerp(from: &[f64], to: &[f64], part: f64, out: &mut Vec<f64>) {
    let angle = half_angle(from, to);
    let sign = if dot(from, to) < 0.0 { -1.0 } else { 1.0 };
    // Nearly equal rotations lie on a straight line.
    let (a, b) = if angle < 1e-9 {
        (1.0 - part, part)
    } else {
        (
            libm::sin((1.0 - part) * angle) / libm::sin(angle),
            libm::sin(part * angle) / libm::sin(angle),
        )
    };
    out.extend(from.iter().zip(to).map(|(x, y)| a * x + sign * b * y));
}

/// A rotation, all equally likely (Shoemake, *Uniform random rotations*, 1992).
fn rotation(random: &mut dyn Random) -> [f64; 4] {
    let [u, v, w] = [random.next(), random.next(), random.next()];
    let (a, b) = ((1.0 - u).sqrt(), u.sqrt());
    let (v, w) = (libm::sincos(TAU * v), libm::sincos(TAU * w));
    [a * v.0, a * v.1, b * w.0, b * w.1]
}

/// A rotation at most `distance` (half an angle) from another.
fn rotation_near(random: &mut dyn Random, near: &[f64], distance: f64) -> [f64; 4] {
    if distance >= FRAC_PI_2 {
        return rotation(random);
    }
    let mut axis = [random.normal(), random.normal(), random.normal()];
    let length = dot(&axis, &axis).sqrt().max(f64::MIN_POSITIVE);
    // The cube root makes all rotations within the distance about equally likely.
    let (sin, cos) = libm::sincos(distance * libm::cbrt(random.next()));
    axis.iter_mut().for_each(|part| *part *= sin / length);
    product(
        [axis[0], axis[1], axis[2], cos],
        [near[0], near[1], near[2], near[3]],
    )
}

fn product(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    ]
}
