//! A body on joints: where it is, how it responds to impulses, what velocity it gets.

use geometry::Pose;
use nalgebra::{Matrix3, Matrix6, Quaternion, UnitQuaternion, Vector3, Vector6};

use crate::fast_rotor::FastRotor;
use crate::geometric_stiffness::GeometricStiffness;
use crate::jacobian::{InverseMass, halves};
use crate::spatial;
use crate::spatial_inertia::SpatialInertia;

/// Up to here the series of a rotation are used: half its angle, rad.
const SMALL_HALF_ANGLE: f64 = 0.01;

/// The constant properties of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyProperties {
    /// 1/kg; 0 for bodies that no force moves.
    pub(crate) inverse_mass: f64,
    inertia: Matrix3<f64>,
    inverse_inertia: Matrix3<f64>,
    com: Vector3<f64>,
}

/// Position, orientation and velocities of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion {
    /// Pose of the body's frame in the world.
    pub pose: Pose,
    /// Of the centre of mass (m/s), then angular (rad/s), along the axes of the world.
    pub velocity: Vector6<f64>,
}

/// The input of a body for a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyState {
    /// Pose and velocities at the begin of the step.
    pub motion: BodyMotion,
    /// External force and torque about the centre of mass, world axes, without gravity and the gyroscopic torque (N, N m).
    pub force: Vector6<f64>,
    /// The angular velocity at the end of the step if only the gyroscopic torque acted, as the engine integrates it.
    pub gyroscopic_velocity: Vector3<f64>,
    /// The pose at the end of the step of a body without forces; None if it rests.
    pub target: Option<Pose>,
}

impl BodyProperties {
    /// A body that forces move: kg, kg m2 about the centre of mass along the axes of the body, m. An inertia that cannot be inverted does not
    /// let the body turn.
    pub fn dynamic(mass: f64, inertia: Matrix3<f64>, com: Vector3<f64>) -> Self {
        let inverse_inertia = inertia.try_inverse().unwrap_or_else(Matrix3::zeros);
        Self {
            inverse_mass: 1.0 / mass,
            inertia,
            inverse_inertia,
            com,
        }
    }

    /// A body that no force moves: it rests, or is moved from place to place.
    pub fn immovable(com: Vector3<f64>) -> Self {
        Self {
            inverse_mass: 0.0,
            inertia: Matrix3::zeros(),
            inverse_inertia: Matrix3::zeros(),
            com,
        }
    }

    /// Whether torques turn the body.
    pub(crate) fn can_turn(&self) -> bool {
        self.inverse_inertia != Matrix3::zeros()
    }

    /// Whether forces move the body.
    pub fn is_dynamic(&self) -> bool {
        self.inverse_mass > 0.0
    }
}

/// A body on joints.
pub(crate) struct LinkedBody {
    pub properties: BodyProperties,
    pub pose: Pose,
    /// Centre of mass, world.
    pub com: Vector3<f64>,
    /// Inertia about the centre of mass, what was added to it included; world axes.
    pub inertia: Matrix3<f64>,
    /// The response to impulses, with that inertia.
    inverse_mass: InverseMass,
    /// Velocity before all impulses, gravity included, and with them.
    free_velocity: Vector6<f64>,
    present_velocity: Vector6<f64>,
    pub velocity: Vector6<f64>,
    /// Impulses of the joints.
    pub joint_impulse: Vector6<f64>,
    /// Impulses of the contacts that are solved with the mechanism.
    pub contact_impulse: Vector6<f64>,
    /// How contacts resist motion that are solved with the joints.
    pub contact_inertia: Option<SpatialInertia>,
    /// Impulses of external forces, contacts and the gyroscopic torque.
    pub external_impulse: Vector6<f64>,
    pub geometric_stiffness: GeometricStiffness,
    /// A free body that touches the mechanism: the engine applies its gyroscopic torque.
    pub is_guest: bool,
    /// The displacement by the position correction.
    pub correction: Vector6<f64>,
    /// Angular impulse of the gyroscopic torque.
    gyroscopic_impulse: Vector3<f64>,
    /// Of a body that turns far in a step.
    pub rotor: Option<FastRotor>,
}

/// The pose of a body during position correction.
pub(crate) struct Placement {
    pose: Pose,
    com: Vector3<f64>,
    correction: Vector6<f64>,
}

impl LinkedBody {
    pub(crate) fn new(properties: BodyProperties) -> Self {
        Self {
            properties,
            pose: Pose::identity(),
            com: Vector3::zeros(),
            inertia: properties.inertia,
            inverse_mass: InverseMass {
                linear: properties.inverse_mass,
                angular: properties.inverse_inertia,
            },
            free_velocity: Vector6::zeros(),
            present_velocity: Vector6::zeros(),
            velocity: Vector6::zeros(),
            joint_impulse: Vector6::zeros(),
            contact_impulse: Vector6::zeros(),
            contact_inertia: None,
            external_impulse: Vector6::zeros(),
            geometric_stiffness: GeometricStiffness::default(),
            is_guest: false,
            correction: Vector6::zeros(),
            gyroscopic_impulse: Vector3::zeros(),
            rotor: None,
        }
    }

    /// A free body that touches the mechanism.
    pub(crate) fn guest(properties: BodyProperties) -> Self {
        Self {
            is_guest: true,
            ..Self::new(properties)
        }
    }

    pub(crate) fn is_dynamic(&self) -> bool {
        self.properties.is_dynamic()
    }

    pub(crate) fn set_pose(&mut self, pose: Pose) {
        self.place(pose);
        self.update_inertia();
    }

    /// Moves the body without changing its response to impulses.
    pub(crate) fn place(&mut self, pose: Pose) {
        self.pose = pose;
        self.com = pose.transform_point(&self.properties.com.into()).coords;
    }

    /// Computes the inertia for the present orientation, with what is added.
    pub(crate) fn update_inertia(&mut self) {
        let turn = self.pose.rotation.to_rotation_matrix();
        let along_world =
            |tensor: &Matrix3<f64>| turn.matrix() * tensor * turn.matrix().transpose();
        self.inertia = along_world(&self.properties.inertia);
        let mut inverse = along_world(&self.properties.inverse_inertia);
        if let Some(added) = self.geometric_stiffness.added_inertia() {
            self.inertia += added;
            inverse = self.inertia.try_inverse().unwrap_or(inverse);
        }
        self.inverse_mass.angular = inverse;
    }

    /// A tensor of the body along the axes of the world.
    fn along_world(&self, tensor: &Matrix3<f64>) -> Matrix3<f64> {
        let turn = self.pose.rotation.to_rotation_matrix();
        turn.matrix() * tensor * turn.matrix().transpose()
    }

    /// The response to impulses about the centre of mass, world axes.
    pub(crate) fn inverse_mass(&self) -> InverseMass {
        self.inverse_mass
    }

    /// Mass and inertia about the centre of mass, world axes.
    pub(crate) fn mass_matrix(&self) -> Matrix6<f64> {
        let mut matrix = Matrix6::from_diagonal_element(1.0 / self.properties.inverse_mass);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.inertia);
        matrix
    }

    /// Inertia of a body that forces move, with the resistance of its contacts, world axes.
    pub(crate) fn spatial_inertia(&self) -> SpatialInertia {
        if !self.is_dynamic() {
            return SpatialInertia::zero();
        }
        let own = SpatialInertia::of_body(1.0 / self.properties.inverse_mass, self.inertia);
        match &self.contact_inertia {
            Some(contacts) => own.plus(contacts),
            None => own,
        }
    }

    /// Predicts the velocity at the end of the step without joints, and collects the other impulses.
    pub(crate) fn predict(&mut self, state: &BodyState, gravity: Vector3<f64>, step: f64) {
        self.present_velocity = state.motion.velocity;
        if !self.is_dynamic() {
            self.free_velocity = state
                .target
                .map_or_else(Vector6::zeros, |target| self.velocity_to(&target, step));
            return;
        }
        let linear = state.motion.velocity.fixed_rows::<3>(0) + gravity * step;
        let spin = state.motion.velocity.fixed_rows::<3>(3).into_owned();
        self.gyroscopic_impulse = self
            .rotor_impulse(&spin, step)
            .unwrap_or_else(|| self.angular_momentum(&(state.gyroscopic_velocity - spin)));
        self.external_impulse =
            state.force * step + spatial(Vector3::zeros(), self.gyroscopic_impulse);
        self.free_velocity = spatial(linear, spin);
    }

    /// The velocity of a body that is at `target` after the step.
    fn velocity_to(&self, target: &Pose, step: f64) -> Vector6<f64> {
        let shift = target.transform_point(&self.properties.com.into()).coords - self.com;
        let turn = (target.rotation * self.pose.rotation.inverse()).scaled_axis();
        spatial(shift, turn) / step
    }

    /// The velocity without any impulse but that of gravity.
    pub(crate) fn free_velocity(&self) -> Vector6<f64> {
        self.free_velocity
    }

    /// All impulses but those of joints and gravity.
    pub(crate) fn known_impulse(&self) -> Vector6<f64> {
        self.external_impulse + self.contact_impulse
    }

    /// The momentum with all impulses but those of joints.
    pub(crate) fn free_momentum(&self) -> Vector6<f64> {
        self.momentum(&self.free_velocity) + self.known_impulse()
    }

    /// The momentum without the impulses of joints and contacts.
    pub(crate) fn external_momentum(&self) -> Vector6<f64> {
        self.momentum(&self.free_velocity) + self.external_impulse
    }

    /// The impulse of joints that leads to the velocity.
    pub(crate) fn missing_impulse(&self) -> Vector6<f64> {
        self.momentum(&(self.velocity - self.free_velocity)) - self.known_impulse()
    }

    /// The momentum at a velocity.
    pub(crate) fn momentum(&self, velocity: &Vector6<f64>) -> Vector6<f64> {
        let (linear, angular) = halves(velocity);
        spatial(
            linear / self.properties.inverse_mass,
            self.inertia * angular,
        )
    }

    /// The velocity before the step.
    pub(crate) fn present_velocity(&self) -> Vector6<f64> {
        self.present_velocity
    }

    /// Inertia along the axes of the world.
    pub(crate) fn world_inertia(&self) -> Matrix3<f64> {
        self.along_world(&self.properties.inertia)
    }

    /// The inertia times an angular velocity, both along the axes of the world.
    fn angular_momentum(&self, velocity: &Vector3<f64>) -> Vector3<f64> {
        let turn = self.pose.rotation;
        turn * (self.properties.inertia * turn.inverse_transform_vector(velocity))
    }

    /// Moves the centre of mass and turns about it.
    pub(crate) fn displace(&mut self, by: &Vector6<f64>) {
        self.pose = self.displaced(by);
        self.com += by.fixed_rows::<3>(0);
        self.correction += by;
    }

    /// The pose after the centre of mass moved and the body turned about it.
    pub(crate) fn displaced(&self, by: &Vector6<f64>) -> Pose {
        let rotation = rotation_by(&by.fixed_rows::<3>(3).into_owned()) * self.pose.rotation;
        let com = self.com + by.fixed_rows::<3>(0);
        Pose::from_parts((com - rotation * self.properties.com).into(), rotation)
    }

    /// Turns about the centre of mass.
    pub(crate) fn turn_to(&mut self, rotation: UnitQuaternion<f64>) {
        self.pose = Pose::from_parts((self.com - rotation * self.properties.com).into(), rotation);
    }

    pub(crate) fn placement(&self) -> Placement {
        Placement {
            pose: self.pose,
            com: self.com,
            correction: self.correction,
        }
    }

    pub(crate) fn restore(&mut self, placement: &Placement) {
        (self.pose, self.com, self.correction) =
            (placement.pose, placement.com, placement.correction);
    }

    /// The impulse that gives the body of an engine, which applies external forces by itself and knows no added inertia, the
    /// velocity that `of_joints` gives this one.
    pub(crate) fn engine_impulse(&self) -> Vector6<f64> {
        let found = self.joint_impulse + self.contact_impulse;
        if self.is_guest {
            return found;
        }
        let angular = found.fixed_rows::<3>(3) + self.gyroscopic_impulse;
        spatial(
            found.fixed_rows::<3>(0).into_owned(),
            self.without_added_inertia(angular),
        )
    }

    fn without_added_inertia(&self, angular: Vector3<f64>) -> Vector3<f64> {
        if self.geometric_stiffness.added_inertia().is_none() {
            return angular;
        }
        let external = self.external_impulse.fixed_rows::<3>(3) - self.gyroscopic_impulse;
        self.angular_momentum(&(self.inverse_mass().angular * (angular + external))) - external
    }
}

/// The rotation by a vector. Small ones by the first terms of the series of sine and cosine, which are exact to the last digits.
fn rotation_by(vector: &Vector3<f64>) -> UnitQuaternion<f64> {
    let square = vector.norm_squared() / 4.0;
    if square > SMALL_HALF_ANGLE * SMALL_HALF_ANGLE {
        return UnitQuaternion::from_scaled_axis(*vector);
    }
    let cosine = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0));
    let sine = 0.5 - square / 12.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0));
    UnitQuaternion::new_unchecked(Quaternion::from_parts(cosine, vector * sine))
}
