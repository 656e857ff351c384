//! The points of the line through the control points: corners are rounded by quadratic Bezier curves (spec: vrep-era 3.2).

use geometry::pose::{interpolate, rotation_axis};

use crate::Pose;

/// Points closer together than this, in metres and in radians, are merged.
const MERGE_DISTANCE: f64 = 0.0001;
const MERGE_ANGLE: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// Unit vectors with a larger dot product count as parallel.
const PARALLEL: f64 = 0.99999;
/// Rotation axes with a larger dot product count as parallel.
const PARALLEL_AXES: f64 = 0.99;
/// Smaller rotations, in radians, count as none: their axis is not defined well.
const MIN_ROTATION: f64 = 1.0 * std::f64::consts::PI / 180.0;

/// How the length of a segment is measured (`sim.distcalcmethod_*`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LengthMethod {
    /// Translation, metres.
    Distance = 0,
    /// Rotation, converted to metres.
    Angle = 1,
    /// The larger of both.
    Larger = 2,
    /// Their sum.
    Sum = 3,
    /// The square root of the sum of their squares.
    RootOfSquares = 4,
    /// The translation, or the rotation of a segment without translation.
    DistanceElseAngle = 5,
    /// The rotation, or the translation of a segment without rotation.
    AngleElseDistance = 6,
}

impl LengthMethod {
    /// The method with the number of `sim.distcalcmethod_*`.
    pub fn from_number(number: i64) -> Option<Self> {
        let all = [
            Self::Distance,
            Self::Angle,
            Self::Larger,
            Self::Sum,
            Self::RootOfSquares,
            Self::DistanceElseAngle,
            Self::AngleElseDistance,
        ];
        all.into_iter().find(|method| *method as i64 == number)
    }

    /// Length of the way between two poses; `coefficient` is metres per radian.
    pub fn length(self, from: &Pose, to: &Pose, coefficient: f64) -> f64 {
        let distance = (to.translation.vector - from.translation.vector).norm();
        let (_, angle) = rotation_axis(from, to);
        let turn = angle * coefficient;
        match self {
            Self::Distance => distance,
            Self::Angle => turn,
            Self::Larger => distance.max(turn),
            Self::Sum => distance + turn,
            Self::RootOfSquares => (distance * distance + turn * turn).sqrt(),
            Self::DistanceElseAngle if distance < 0.00005 => turn,
            Self::DistanceElseAngle => distance,
            Self::AngleElseDistance if angle < 0.01_f64.to_radians() => distance,
            Self::AngleElseDistance => turn,
        }
    }
}

/// A control point, in the frame of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControlPoint {
    /// Position and orientation in the frame of the path.
    pub pose: Pose,
    /// Part of half the segment before it that is rounded, 0.1 to 0.99.
    pub before: f64,
    /// Part of half the segment after it that is rounded, 0.1 to 0.99.
    pub after: f64,
    /// Number of points of the rounding, 1 to 100; 1 keeps the corner.
    pub count: usize,
    /// Relative velocity, 0 to 1, that the nominal velocity is multiplied with.
    pub velocity: f64,
    /// Virtual distance, metres: a difference to the next point is travelled in addition, even without motion.
    pub on_spot: f64,
    /// Bits for scripts.
    pub flags: u16,
    /// Four values for scripts, interpolated along the path.
    pub channels: [f64; 4],
}

impl ControlPoint {
    /// With numbers brought into their limits.
    pub fn limited(mut self) -> Self {
        let within = |value: f64, low: f64, high: f64, other: f64| {
            if value.is_finite() {
                value.clamp(low, high)
            } else {
                other
            }
        };
        self.before = within(self.before, 0.1, 0.99, 0.5);
        self.after = within(self.after, 0.1, 0.99, 0.5);
        self.count = match self.count.clamp(1, 100) {
            2 => 1,
            count => count,
        };
        self.velocity = within(self.velocity, 0.0, 1.0, 1.0);
        self.on_spot = within(self.on_spot, 0.0, f64::MAX, 0.0);
        self.channels = self
            .channels
            .map(|channel| if channel.is_finite() { channel } else { 0.0 });
        self
    }

    fn point(&self) -> LinePoint {
        LinePoint {
            pose: self.pose,
            velocity: self.velocity,
            on_spot: self.on_spot,
            flags: self.flags,
            channels: self.channels,
        }
    }
}

/// A point of the line that runs through the control points; its fields are those of [`ControlPoint`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePoint {
    /// Position and orientation in the frame of the path.
    pub pose: Pose,
    /// Relative velocity, 0 to 1.
    pub velocity: f64,
    /// Virtual distance, metres.
    pub on_spot: f64,
    /// Bits for scripts, of the nearest control point.
    pub flags: u16,
    /// Four values for scripts, interpolated.
    pub channels: [f64; 4],
}

impl LinePoint {
    /// The point at `t` from this one (0) to `other` (1), with the flags of this one.
    pub fn between(&self, other: &Self, t: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * t;
        Self {
            pose: interpolate(&self.pose, &other.pose, t),
            velocity: mix(self.velocity, other.velocity),
            on_spot: mix(self.on_spot, other.on_spot),
            flags: self.flags,
            channels: std::array::from_fn(|at| mix(self.channels[at], other.channels[at])),
        }
    }

    fn is_same_place(&self, other: &Self) -> bool {
        is_same(&self.pose, &other.pose)
            && rotation_axis(&self.pose, &other.pose).1 < MERGE_ANGLE
            && self.on_spot == other.on_spot
    }
}

fn is_same(a: &Pose, b: &Pose) -> bool {
    (a.translation.vector - b.translation.vector).norm() < MERGE_DISTANCE
}

/// The line through control points.
pub(super) fn line(points: &[ControlPoint], closed: bool) -> Vec<LinePoint> {
    let count = points.len();
    let mut line = Vec::new();
    for (at, point) in points.iter().enumerate() {
        let is_end = !closed && (at == 0 || at + 1 == count);
        if count < 3 || is_end {
            line.push(point.point());
        } else {
            let before = &points[(at + count - 1) % count];
            corner(&mut line, before, point, &points[(at + 1) % count]);
        }
    }
    line.dedup_by(|next, kept| count >= 3 && next.is_same_place(kept));
    line
}

fn corner(
    line: &mut Vec<LinePoint>,
    before: &ControlPoint,
    corner: &ControlPoint,
    after: &ControlPoint,
) {
    let middle = corner.point();
    if corner.count == 1 || !is_rounded(before, corner, after) {
        line.push(middle);
        return;
    }
    let half_way = |other: &ControlPoint| LinePoint {
        flags: corner.flags,
        ..other.point().between(&middle, 0.5)
    };
    let start = half_way(before).between(&middle, 1.0 - corner.before);
    let end = half_way(after).between(&middle, 1.0 - corner.after);
    line.push(start);
    for k in 1..corner.count - 1 {
        let t = k as f64 / (corner.count - 1) as f64;
        line.push(
            start
                .between(&middle, t)
                .between(&middle.between(&end, t), t),
        );
    }
    line.push(end);
}

/// Whether the way bends, turns about another axis, or stands still at the corner.
fn is_rounded(before: &ControlPoint, corner: &ControlPoint, after: &ControlPoint) -> bool {
    let [a, b, c] = [before, corner, after].map(|point| &point.pose);
    let apart = !is_same(a, b) && !is_same(b, c) && !is_same(a, c);
    let way =
        |from: &Pose, to: &Pose| (to.translation.vector - from.translation.vector).normalize();
    let bends = apart && way(a, b).dot(&way(b, c)) < PARALLEL;
    let (first, second) = (rotation_axis(a, b), rotation_axis(b, c));
    let product: f64 = first.0.iter().zip(second.0).map(|(x, y)| x * y).sum();
    let turns = first.1 > MIN_ROTATION && second.1 > MIN_ROTATION && product < PARALLEL_AXES;
    let stands = corner.on_spot != before.on_spot && corner.on_spot != after.on_spot;
    bends || turns || stands
}
