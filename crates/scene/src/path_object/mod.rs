//! Path objects of V-REP (spec: vrep-era 3): control points, the line through them, and a position that moves along it.
//!
//! Paths of today are dummies with custom data, made by scripts; those are not meant here. Names and addresses of objects are in
//! `tree/path.rs`.

mod attached;
mod line;
mod orientation;
mod travel;
mod velocity;

pub use attached::PathFollowing;
pub use line::{ControlPoint, LengthMethod, LinePoint};
pub use travel::{Travel, TravelLimits};

use bitflags::bitflags;

use crate::appearance::colour::Colour;
use crate::{Pose, SceneError, SceneResult};

/// Limit of control points: more of them are a mistake of a script or file.
const MAX_POINTS: usize = 100_000;
/// Limit of the target velocity, m/s.
const MAX_VELOCITY: f64 = 1000.0;

bitflags! {
    /// `sim.pathproperty_*`. Bits without a name concern the display.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct PathAttributes: i32 {
        /// The line is displayed.
        const SHOW_LINE = 0x1;
        /// The last control point is followed by the first.
        const CLOSED = 0x4;
        /// Orientations follow from the direction of the path.
        const AUTOMATIC_ORIENTATION = 0x8;
        /// The velocity changes its sign at the ends.
        const INVERT_VELOCITY = 0x10;
        /// The nominal velocity is the target velocity at once.
        const INFINITE_ACCELERATION = 0x20;
        /// All control points have z = 0.
        const FLAT = 0x40;
        /// Bends limit the velocity.
        const TRANSLATION_PROFILE = 0x100;
        /// Changes of the axis of rotation limit the velocity.
        const ROTATION_PROFILE = 0x200;
        /// At rest at the ends of an open path.
        const REST_AT_ENDS = 0x400;
        /// With automatic orientation, the x axis points up as far as possible.
        const KEEP_X_UP = 0x800;
        const _ = !0;
    }
}

impl PathAttributes {
    /// Those of a new path.
    pub const DEFAULT: Self = Self::from_bits_retain(0x4ab);
}

/// Constants of the automatic velocity profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VelocityProfile {
    /// Radius of a bend that is passed at full velocity.
    pub radius: f64,
    /// Relative velocity where an axis of rotation changes.
    pub axis_change: f64,
    /// Acceleration of the relative velocity.
    pub acceleration: f64,
}

/// What a shape along the path would look like. Kept for files.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaping {
    /// Bits as the file has them.
    pub flags: u8,
    /// Scale of the cross-section.
    pub scale: f64,
    /// Length of an element (metres), and type of the cross-section.
    pub element: (f64, i32),
    /// Coordinates of the cross-section, as the file has them.
    pub section: Vec<f64>,
    /// Colour of the shape.
    pub colour: Colour,
}

/// A path object of V-REP.
#[derive(Debug, Clone, PartialEq)]
pub struct PathObject {
    attributes: PathAttributes,
    control_points: Vec<ControlPoint>,
    /// Computed from the control points, as are the lengths and velocities.
    line: Vec<LinePoint>,
    /// Length from the start to each point of the line, and to the start again if closed; metres.
    lengths: Vec<f64>,
    /// Relative velocity at each of these.
    velocities: Vec<f64>,
    /// Metres of length.
    position: f64,
    /// Velocity along the path where the relative velocity is 1, m/s.
    pub nominal_velocity: f64,
    /// The velocity that the nominal velocity approaches, m/s.
    pub target_velocity: f64,
    /// Acceleration of the nominal velocity, m/s^2.
    pub max_acceleration: f64,
    /// Metres of length per radian of rotation.
    angle_coefficient: f64,
    on_spot_coefficient: f64,
    length_method: LengthMethod,
    profile: VelocityProfile,
    /// Left out when all paths are handled.
    pub explicit: bool,
    /// Displayed width of the line, pixels.
    pub line_size: i32,
    /// Displayed size of control points, metres.
    pub point_size: f64,
    /// The shape along the path, if the file describes one.
    pub shaping: Option<Shaping>,
}

/// What a path is measured by: of `sim.createPath`, and of files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathMeasures {
    /// How translation and rotation add to the length.
    pub length_method: LengthMethod,
    /// Metres of length per radian of rotation.
    pub angle_coefficient: f64,
    /// Metres of length per metre of virtual distance.
    pub on_spot_coefficient: f64,
    /// The automatic velocity profile.
    pub profile: VelocityProfile,
}

impl Default for PathMeasures {
    fn default() -> Self {
        Self {
            length_method: LengthMethod::DistanceElseAngle,
            angle_coefficient: 0.1 / std::f64::consts::FRAC_PI_2,
            on_spot_coefficient: 1.0,
            profile: VelocityProfile {
                radius: 0.2,
                axis_change: 0.5,
                acceleration: 0.1,
            },
        }
    }
}

impl PathObject {
    /// A path without points.
    pub fn new(attributes: PathAttributes, measures: PathMeasures) -> Self {
        Self {
            attributes,
            control_points: Vec::new(),
            line: Vec::new(),
            lengths: Vec::new(),
            velocities: Vec::new(),
            position: 0.0,
            nominal_velocity: 0.0,
            target_velocity: 0.0,
            max_acceleration: 0.01,
            angle_coefficient: measures.angle_coefficient,
            on_spot_coefficient: measures.on_spot_coefficient,
            length_method: measures.length_method,
            profile: measures.profile,
            explicit: false,
            line_size: 1,
            point_size: 0.01,
            shaping: None,
        }
    }

    /// Its attributes.
    pub fn attributes(&self) -> PathAttributes {
        self.attributes
    }

    /// Whether it leads back to its beginning. With fewer than three points it does not, whatever its attributes.
    pub fn is_closed(&self) -> bool {
        self.attributes.contains(PathAttributes::CLOSED)
            && self.control_points.len() >= 3
            && self.line.len() >= 3
    }

    /// The points of the line in the path's frame; the first comes again at the end of a closed one.
    pub fn outline(&self) -> impl Iterator<Item = nalgebra::Vector3<f64>> {
        let end = self.line.first().filter(|_| self.is_closed());
        self.line
            .iter()
            .chain(end)
            .map(|point| point.pose.translation.vector)
    }

    /// The control points in order, in the frame of the path.
    pub fn control_points(&self) -> &[ControlPoint] {
        &self.control_points
    }

    /// How its length and velocity profile are computed.
    pub fn measures(&self) -> PathMeasures {
        PathMeasures {
            length_method: self.length_method,
            angle_coefficient: self.angle_coefficient,
            on_spot_coefficient: self.on_spot_coefficient,
            profile: self.profile,
        }
    }

    /// Inserts control points before the one at `index`, or at the end, and closes or opens the path.
    ///
    /// # Errors
    /// When there are too many.
    pub fn insert(
        &mut self,
        index: usize,
        points: Vec<ControlPoint>,
        closed: bool,
    ) -> SceneResult<()> {
        if self.control_points.len() + points.len() > MAX_POINTS {
            return Err(SceneError::Refused(format!(
                "a path has at most {MAX_POINTS} control points."
            )));
        }
        let index = index.min(self.control_points.len());
        self.control_points.splice(index..index, points);
        self.attributes.set(PathAttributes::CLOSED, closed);
        self.update();
        Ok(())
    }

    /// Removes control points; what is beyond the end does not count.
    pub fn cut(&mut self, start: usize, count: usize) {
        let start = start.min(self.control_points.len());
        let end = start.saturating_add(count).min(self.control_points.len());
        self.control_points.drain(start..end);
        self.update();
    }

    /// Length of the whole path, metres.
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// Metres of length from the start.
    pub fn position(&self) -> f64 {
        self.position
    }

    /// Moves the position; see [`on_path`](Self::on_path).
    pub fn set_position(&mut self, position: f64) {
        self.position = self.on_path(position);
    }

    /// Sets the target velocity, limited to 1000 m/s in both directions.
    pub fn set_target_velocity(&mut self, velocity: f64) {
        self.target_velocity = velocity.clamp(-MAX_VELOCITY, MAX_VELOCITY);
    }

    /// A position on the path: wrapped if the path is closed, else limited to it.
    pub fn on_path(&self, position: f64) -> f64 {
        let length = self.length();
        if length <= 0.0 || !position.is_finite() {
            0.0
        } else if self.is_closed() {
            position.rem_euclid(length)
        } else {
            position.clamp(0.0, length)
        }
    }

    /// The pose of a control point.
    pub fn control_pose(&self, index: usize) -> Option<Pose> {
        self.control_points.get(index).map(|point| point.pose)
    }

    /// The line at a position (metres), which is wrapped or limited; None without points.
    pub fn at(&self, position: f64) -> Option<LinePoint> {
        let (first, second, t) = self.place(position)?;
        let mut point = first.between(second, t);
        point.flags = if t < 0.5 { first.flags } else { second.flags };
        Some(point)
    }

    /// The two points of the line around a position, and how far it is from the first to the second.
    fn place(&self, position: f64) -> Option<(&LinePoint, &LinePoint, f64)> {
        let first = self.line.first()?;
        if self.lengths.len() < 2 {
            return Some((first, first, 0.0));
        }
        let position = self.on_path(position);
        let segment = self.segment_at(position);
        let span = self.lengths[segment + 1] - self.lengths[segment];
        let t = if span > 0.0 {
            (position - self.lengths[segment]) / span
        } else {
            0.0
        };
        Some((
            &self.line[segment],
            &self.line[(segment + 1) % self.line.len()],
            t,
        ))
    }

    /// The last segment that begins at or before a position.
    fn segment_at(&self, position: f64) -> usize {
        let inner = &self.lengths[1..self.lengths.len() - 1];
        inner.partition_point(|&length| length <= position)
    }

    /// The position (metres) that is closest to a point of the path's frame; None without points. The first of several.
    pub fn closest_position(&self, point: &nalgebra::Vector3<f64>) -> Option<f64> {
        self.line.first()?;
        let mut best = (f64::INFINITY, 0.0);
        for (segment, span) in self.lengths.windows(2).enumerate() {
            let [from, to] = [segment, (segment + 1) % self.line.len()]
                .map(|at| self.line[at].pose.translation.vector);
            let way = to - from;
            let square = way.norm_squared();
            let t = if square > 0.0 {
                ((point - from).dot(&way) / square).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let distance = (from + way * t - point).norm_squared();
            if distance < best.0 {
                best = (distance, span[0] + t * (span[1] - span[0]));
            }
        }
        Some(best.1)
    }

    /// Computes what follows from the control points.
    fn update(&mut self) {
        if self.attributes.contains(PathAttributes::FLAT) {
            self.control_points
                .iter_mut()
                .for_each(|point| point.pose.translation.z = 0.0);
        }
        let closed =
            self.attributes.contains(PathAttributes::CLOSED) && self.control_points.len() >= 3;
        self.orient_control_points(closed);
        self.line = line::line(&self.control_points, closed);
        if self.control_points.len() < 3 || self.line.len() < 3 {
            self.attributes.remove(PathAttributes::CLOSED);
        }
        let closed = self.is_closed();
        self.orient_line(closed);
        self.lengths = self.measured(closed);
        self.velocities = self.relative_velocities(closed);
        self.position = self.on_path(self.position);
    }

    fn measured(&self, closed: bool) -> Vec<f64> {
        let mut length = 0.0;
        let mut lengths = Vec::with_capacity(self.line.len() + 1);
        lengths.extend(self.line.first().map(|_| 0.0));
        let ends = self
            .line
            .iter()
            .skip(1)
            .chain(self.line.first().filter(|_| closed));
        for (from, to) in self.line.iter().zip(ends) {
            length += self.segment_length(from, to);
            lengths.push(length);
        }
        lengths
    }

    fn segment_length(&self, from: &LinePoint, to: &LinePoint) -> f64 {
        let length = self
            .length_method
            .length(&from.pose, &to.pose, self.angle_coefficient);
        length + (to.on_spot - from.on_spot).abs() * self.on_spot_coefficient
    }

    /// Position, nominal and target velocity: what a simulation restores.
    pub(crate) fn motion(&self) -> [f64; 3] {
        [self.position, self.nominal_velocity, self.target_velocity]
    }

    pub(crate) fn restore_motion(&mut self, [position, nominal, target]: [f64; 3]) {
        self.set_position(position);
        (self.nominal_velocity, self.target_velocity) = (nominal, target);
    }

    /// Takes over what a file says of the motion.
    pub fn set_motion(&mut self, position: f64, max_acceleration: f64, nominal: f64, target: f64) {
        self.set_position(position);
        (self.max_acceleration, self.nominal_velocity) = (max_acceleration, nominal);
        self.set_target_velocity(target);
    }

    /// Scales all lengths.
    pub(crate) fn scale(&mut self, factor: f64) {
        for point in &mut self.control_points {
            point.pose.translation.vector *= factor;
            point.on_spot *= factor;
        }
        self.angle_coefficient *= factor;
        self.point_size *= factor;
        self.profile.radius *= factor;
        let position = self.position * factor;
        self.update();
        self.set_position(position);
    }
}

#[cfg(test)]
mod tests;
