//! Setters of joints: mode, interval, position, targets, control (spec: joints 4, joints 5, joints 6, joints 7).
//!
//! Motions are started and ended here; `motion` steps them, `dependency` moves dependent joints.

use std::f64::consts::{FRAC_PI_2, PI};

use geometry::Finite;
use geometry::pose::euler::wrap_angle;

use super::{Control, Joint, JointMode, JointMotion, JointType};
use crate::{Field, Handle, Scene, SceneError, SceneResult};

/// Largest magnitude of the lower limit: rad of revolute, m of prismatic joints.
const MAX_LOWER_LIMIT: (f64, f64) = (1e5, 1e3);
/// Width of the widest interval: rad (1e7 degrees) and m.
const MAX_RANGE: (f64, f64) = (1e7 * PI / 180.0, 1e3);
/// Width of the narrowest interval of a revolute joint: 0.001 degrees, rad.
const MIN_TURN: f64 = 0.001 * PI / 180.0;
/// Velocity that makes force and spring control limited by the force alone.
const UNREACHABLE_VELOCITY: f64 = 1000.0;
/// Largest screw lead, m per turn.
const MAX_SCREW_LEAD: f64 = 20.0 * PI;

impl Joint {
    /// The position that results from setting `position`: wrapped if cyclic, else limited to the interval.
    pub(crate) fn limited(&self, position: f64) -> f64 {
        if self.cyclic {
            wrap_angle(position)
        } else {
            position.max(self.min).min(self.min + self.range)
        }
    }

    /// Target position minus `position`; for cyclic joints the shortest way, and half a turn in the direction of its sign.
    pub fn position_error(&self, position: f64) -> f64 {
        let difference = self.target_position - position;
        if self.cyclic {
            wrap_angle(difference)
        } else {
            difference
        }
    }

    /// Upper end of the interval.
    pub fn max(&self) -> f64 {
        self.min + self.range
    }

    /// Fails for spherical joints, which have no position along one axis.
    ///
    /// # Errors
    /// [`SceneError::SphericalJoint`].
    pub fn single_axis(&self) -> SceneResult<()> {
        if self.joint_type == JointType::Spherical {
            Err(SceneError::SphericalJoint)
        } else {
            Ok(())
        }
    }

    /// Sets the interval. A prismatic joint cannot be cyclic; a revolute one that becomes cyclic loses its screw lead.
    pub fn set_interval(&mut self, cyclic: bool, min: f64, range: f64) {
        let revolute = self.is_revolute();
        let pick = |(turn, length): (f64, f64)| if revolute { turn } else { length };
        let narrowest = if revolute { MIN_TURN } else { 0.0 };
        if cyclic && revolute {
            self.screw_lead = 0.0;
        }
        self.cyclic = cyclic && self.joint_type != JointType::Prismatic;
        self.min = min.clamp(-pick(MAX_LOWER_LIMIT), pick(MAX_LOWER_LIMIT));
        self.range = range.clamp(narrowest, pick(MAX_RANGE));
    }

    /// Sets the screw lead (m per turn); ignored where it has no meaning.
    pub fn set_screw_lead(&mut self, lead: f64) {
        if self.is_revolute() && !self.cyclic && self.mode != JointMode::Dynamic {
            self.screw_lead = lead.clamp(-MAX_SCREW_LEAD, MAX_SCREW_LEAD);
        }
    }

    /// Changes the mode with its consequences. Spherical joints cannot be dependent.
    pub fn set_mode(&mut self, mode: JointMode) {
        if mode == JointMode::Dependent && self.joint_type == JointType::Spherical {
            return;
        }
        self.mode = mode;
        self.hybrid = false;
        self.motion = None;
        self.error = None;
        self.target_position = self.position;
        match mode {
            JointMode::Dependent => self.control = Control::Free,
            JointMode::Kinematic | JointMode::Motion | JointMode::InverseKinematics => {
                self.leave_master();
            }
            JointMode::Dynamic => {
                self.leave_master();
                self.free_force_of_velocity();
            }
        }
    }

    /// Follows no joint any more; offset and coefficient stay.
    pub(crate) fn leave_master(&mut self) {
        self.idle_law = self.dependency_law();
        self.dependency = None;
    }

    /// Offset and coefficient of the dependency, or of the last one.
    pub fn dependency_law(&self) -> [f64; 2] {
        self.dependency
            .map_or(self.idle_law, |law| [law.offset, law.coefficient])
    }

    /// Changes the control mode, and the target velocity that belongs to it.
    pub fn set_control(&mut self, control: Control) {
        self.control = control;
        if control == Control::Velocity {
            self.target_velocity = if self.is_revolute() { FRAC_PI_2 } else { 0.1 };
        }
        self.free_force_of_velocity();
    }

    fn free_force_of_velocity(&mut self) {
        if matches!(
            self.control,
            Control::Force | Control::Spring | Control::SpringOrCallback
        ) {
            self.target_velocity = UNREACHABLE_VELOCITY;
        }
    }

    /// Sets the target velocity; the force takes its sign.
    pub fn set_target_velocity(&mut self, velocity: f64) {
        self.target_velocity = velocity;
        if velocity * self.target_force < 0.0 {
            self.target_force = -self.target_force;
        }
    }

    /// Sets the target force (N, N m). Signed: a target velocity takes its sign. Otherwise negative ones count as 0, and the force
    /// takes the sign of the target velocity.
    pub fn set_target_force(&mut self, force: f64, signed: bool) {
        if self.joint_type == JointType::Spherical {
            return;
        }
        if signed {
            self.target_force = force;
            if force * self.target_velocity < 0.0 {
                self.target_velocity = -self.target_velocity;
            }
        } else {
            self.target_force = force.max(0.0)
                * if self.target_velocity < 0.0 {
                    -1.0
                } else {
                    1.0
                };
        }
    }

    /// Sets the velocity, acceleration and jerk limits, in this order; a shorter list leaves the others. A motor takes the first only, as
    /// in the original: the others are set as parameters of the joint.
    fn set_limits(&mut self, limits: &[f64]) {
        let count = if self.mode == JointMode::Kinematic {
            3
        } else {
            1
        };
        let fields = [&mut self.max_vel, &mut self.max_accel, &mut self.max_jerk];
        fields
            .into_iter()
            .zip(limits)
            .take(count)
            .for_each(|(field, limit)| *field = *limit);
    }

    /// Whether targets have no effect: the joint follows its master.
    fn ignores_targets(&self) -> bool {
        self.mode == JointMode::Dependent
    }

    /// Starts or redirects a kinematic motion, keeping the velocity of one in progress.
    fn start(&mut self, motion: JointMotion) {
        if self.mode == JointMode::Kinematic {
            if self.motion.is_none() {
                (self.velocity, self.accel) = (0.0, 0.0);
            }
            self.motion = Some(motion);
        } else {
            self.motion = None;
        }
    }
}

impl Scene {
    /// Sets the position of a joint (rad, m) as scripts do: limited, unless it has a master. Tells whether it was set: a joint that
    /// is moving towards a target is left alone.
    ///
    /// # Errors
    /// For spherical joints and positions that are no number.
    pub fn set_joint_position(&mut self, handle: Handle, position: f64) -> SceneResult<bool> {
        let Some(position) = self.accepted_position(handle, position)? else {
            return Ok(false);
        };
        self.move_joint(handle, position)?;
        Ok(true)
    }

    /// Where a joint goes that a script sets to a position; None for one that is moving towards a target.
    pub(crate) fn accepted_position(
        &self,
        handle: Handle,
        position: f64,
    ) -> SceneResult<Option<f64>> {
        let joint = self.object(handle)?.joint()?;
        joint.single_axis()?;
        [position].finite().ok_or(SceneError::InvalidData)?;
        let position = if joint.dependency.is_some() {
            position
        } else {
            joint.limited(position)
        };
        Ok(joint.motion.is_none().then_some(position))
    }

    /// Sets the mode of a joint. One that becomes dependent moves at once to where its master wants it.
    pub fn set_joint_mode(&mut self, handle: Handle, mode: JointMode) -> SceneResult<()> {
        self.modify_joint(handle, |joint| joint.set_mode(mode))?;
        self.relimit_joint(handle)?;
        self.follow_master(handle)
    }

    /// Sets whether a joint is cyclic, and its lower limit and range; the position follows.
    pub fn set_joint_interval(
        &mut self,
        handle: Handle,
        cyclic: bool,
        [min, range]: [f64; 2],
    ) -> SceneResult<()> {
        [min, range].finite().ok_or(SceneError::InvalidData)?;
        self.modify_joint(handle, |joint| joint.set_interval(cyclic, min, range))?;
        self.relimit_joint(handle)
    }

    /// Brings the position of a joint back into its interval, unless it has a master.
    pub(crate) fn relimit_joint(&mut self, handle: Handle) -> SceneResult<()> {
        let joint = self.object(handle)?.joint()?;
        if joint.joint_type == JointType::Spherical || joint.dependency.is_some() {
            return Ok(());
        }
        let position = joint.limited(joint.position);
        self.move_joint(handle, position)
    }

    /// Sets the target position (rad, m) and the first of the velocity, acceleration and jerk limits.
    ///
    /// # Errors
    /// For spherical joints and targets that are no number.
    pub fn set_joint_target_position(
        &mut self,
        handle: Handle,
        target: f64,
        limits: &[f64],
    ) -> SceneResult<()> {
        self.object(handle)?.joint()?.single_axis()?;
        [target].finite().ok_or(SceneError::InvalidData)?;
        limits.finite().ok_or(SceneError::InvalidData)?;
        self.control_joint(handle, |joint| {
            if joint.ignores_targets() {
                return;
            }
            joint.set_limits(limits);
            joint.target_position = if joint.cyclic {
                wrap_angle(target)
            } else {
                target
            };
            joint.start(JointMotion::ToPosition);
        })
    }

    /// Sets the target velocity (rad/s, m/s) and, of a kinematic joint, the first of the acceleration and jerk limits and the velocity to
    /// start from. A motor keeps its limits, as in the original: they are set as parameters of the joint.
    ///
    /// # Errors
    /// For spherical joints and targets that are no number.
    pub fn set_joint_target_velocity(
        &mut self,
        handle: Handle,
        target: f64,
        limits: &[f64],
        initial: Option<f64>,
    ) -> SceneResult<()> {
        self.object(handle)?.joint()?.single_axis()?;
        [target, initial.unwrap_or(0.0)]
            .finite()
            .ok_or(SceneError::InvalidData)?;
        limits.finite().ok_or(SceneError::InvalidData)?;
        self.control_joint(handle, |joint| {
            if joint.ignores_targets() {
                return;
            }
            if joint.mode == JointMode::Kinematic {
                let fields = [&mut joint.max_accel, &mut joint.max_jerk];
                fields
                    .into_iter()
                    .zip(limits)
                    .for_each(|(field, limit)| *field = *limit);
            }
            joint.set_target_velocity(target);
            joint.start(JointMotion::AtVelocity { initial });
        })
    }

    /// Changes what a joint is to do: targets, forces, gains.
    pub fn control_joint<R>(
        &mut self,
        handle: Handle,
        change: impl FnOnce(&mut Joint) -> R,
    ) -> SceneResult<R> {
        self.try_modify(handle, Field::JointControl, |object| {
            object.joint_mut().map(change)
        })
    }

    /// Changes what kind of joint it is: mode, interval, master.
    pub fn modify_joint<R>(
        &mut self,
        handle: Handle,
        change: impl FnOnce(&mut Joint) -> R,
    ) -> SceneResult<R> {
        self.try_modify(handle, Field::Joint, |object| {
            object.joint_mut().map(change)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cyclic_joint_takes_the_short_way_and_half_a_turn_as_it_was_asked() {
        let joint = |target_position| Joint {
            target_position,
            ..Joint::new(JointType::Revolute, JointMode::Dynamic)
        };
        assert_eq!(
            (
                joint(PI).position_error(0.0),
                joint(-PI).position_error(0.0)
            ),
            (PI, -PI)
        );
        assert!((joint(-3.0).position_error(3.0) - (2.0 * PI - 6.0)).abs() < 1e-12);
        let limited = Joint {
            cyclic: false,
            ..joint(-3.0)
        };
        assert_eq!(limited.position_error(3.0), -6.0);
    }

    #[test]
    fn force_and_velocity_keep_the_same_sign() {
        let mut joint = Joint::new(JointType::Revolute, JointMode::Dynamic);
        joint.set_target_velocity(1.0);
        joint.set_target_force(-5.0, true);
        assert_eq!((joint.target_velocity, joint.target_force), (-1.0, -5.0));
        joint.set_target_force(4.0, false);
        assert_eq!(joint.target_force, -4.0);
    }

    #[test]
    fn a_moving_joint_cannot_be_set() {
        let mut scene = Scene::new();
        let kind = crate::Kind::Joint(Box::new(Joint::new(
            JointType::Prismatic,
            JointMode::Kinematic,
        )));
        let handle = scene.add("j", kind).unwrap();
        assert_eq!(scene.set_joint_position(handle, 0.7), Ok(true));
        assert_eq!(scene.object(handle).unwrap().joint().unwrap().position, 0.5);
        scene.set_joint_target_position(handle, 0.1, &[]).unwrap();
        assert_eq!(scene.set_joint_position(handle, 0.0), Ok(false));
    }
}
