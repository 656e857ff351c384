//! A body that hangs on links: where it is, how it answers impulses, what velocity it gets.

use nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{RigidBody, RigidBodyHandle};

use super::rotor::{Rotor, Spin};
use super::spatial;
use super::taut::Taut;
use crate::dynamics::bodies::Body;
use crate::dynamics::convert::{from_pose, from_vector, is_finite, to_pose, to_vector};
use crate::dynamics::world::World;
use crate::scene::{Handle, Pose};

/// A body that hangs on links.
pub(super) struct Mover {
    pub shape: Handle,
    pub rigid: RigidBodyHandle,
    pub inverse_mass: f64,
    pub inertia: Matrix3<f64>,
    pub inverse_inertia: Matrix3<f64>,
    pub com_in_shape: Vector3<f64>,
    /// Of this sub-step: pose, centre of mass, response to impulses, velocity before and with all impulses.
    pub pose: Pose,
    pub com: Vector3<f64>,
    pub response: Matrix6<f64>,
    pub free: Vector6<f64>,
    pub velocity: Vector6<f64>,
    /// Impulses of scripts and contacts, and of the gyroscopic torque.
    pub push: Vector6<f64>,
    pub taut: Taut,
    /// Forces and torques of scripts.
    asked: [Vector; 2],
    /// How far it was put back after the sub-step.
    pub shift: Vector6<f64>,
    /// Angular impulse of the gyroscopic torque.
    pub gyration: Vector3<f64>,
    /// Of a body that turns far in a sub-step.
    pub rotor: Option<Rotor>,
}

/// Where a body is while the gaps are closed.
pub(super) struct Place {
    pose: Pose,
    com: Vector3<f64>,
    shift: Vector6<f64>,
}

impl Mover {
    pub(super) fn new(shape: Handle, body: &Body) -> Self {
        let mass = &body.build.mass;
        let inverse = (mass.inertia * mass.mass).try_inverse().filter(|_| body.build.dynamic);
        Self {
            shape,
            rigid: body.rigid,
            inverse_mass: if body.build.dynamic { 1.0 / mass.mass } else { 0.0 },
            inertia: mass.inertia * mass.mass,
            inverse_inertia: inverse.unwrap_or_else(Matrix3::zeros),
            com_in_shape: mass.com.into(),
            pose: Pose::identity(),
            com: Vector3::zeros(),
            response: Matrix6::zeros(),
            free: Vector6::zeros(),
            velocity: Vector6::zeros(),
            push: Vector6::zeros(),
            taut: Taut::default(),
            asked: [Vector::ZERO; 2],
            shift: Vector6::zeros(),
            gyration: Vector3::zeros(),
            rotor: None,
        }
    }

    pub(super) fn moves(&self) -> bool {
        self.inverse_mass > 0.0
    }

    /// Reads where the body is.
    pub(super) fn place(&mut self, world: &World) {
        let Some(rigid) = world.bodies.get(self.rigid) else { return };
        self.pose = from_pose(rigid.position());
        self.com = self.pose.transform_point(&self.com_in_shape.into()).coords;
        self.response.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * self.inverse_mass));
        self.respond();
    }

    /// Reads how the body answers angular impulses as it lies.
    pub(super) fn respond(&mut self) {
        let turn = self.pose.rotation.to_rotation_matrix();
        let inverse = turn.matrix() * self.inverse_inertia * turn.matrix().transpose();
        let inverse = match self.taut.added() {
            Some(added) => (self.world_inertia() + added).try_inverse().unwrap_or(inverse),
            None => inverse,
        };
        self.response.fixed_view_mut::<3, 3>(3, 3).copy_from(&inverse);
    }

    /// What velocity the body will have without the links, and what else pushes it.
    pub(super) fn predict(&mut self, world: &World, gravity: [f64; 3], step: f64) {
        let Some(rigid) = world.bodies.get(self.rigid) else { return };
        if !self.moves() {
            self.free = self.swept(rigid, step);
            return;
        }
        self.asked = [rigid.user_force(), rigid.user_torque()];
        let [force, torque] = self.asked.map(|asked| from_vector(asked).into());
        let push = spatial(force, torque) * step;
        let spin = Vector3::from(from_vector(rigid.angvel()));
        self.gyration = self.rotor_impulse(&spin, step).unwrap_or_else(|| {
            self.world_inertia() * (Vector3::from(from_vector(rigid.angvel_with_gyroscopic_forces(step))) - spin)
        });
        self.push = push + spatial(Vector3::zeros(), self.gyration);
        self.free = spatial(Vector3::from(from_vector(rigid.linvel())) + Vector3::from(gravity) * step, spin);
    }

    /// In the axes of the world.
    pub(super) fn world_inertia(&self) -> Matrix3<f64> {
        let turn = self.pose.rotation.to_rotation_matrix();
        turn.matrix() * self.inertia * turn.matrix().transpose()
    }

    /// Whether rapier applies the gyroscopic torque; to a body on links the articulation does, since rapier would apply it to what the
    /// links do as well.
    pub(super) fn leave_gyration_to_rapier(&self, on: bool, world: &mut World) {
        if let Some(rigid) = world.bodies.get_mut(self.rigid) {
            rigid.enable_gyroscopic_forces(on);
        }
    }

    /// Moves the centre of mass and turns about it.
    pub(super) fn shift(&mut self, by: &Vector6<f64>) {
        let rotation = UnitQuaternion::from_scaled_axis(by.fixed_rows::<3>(3).into_owned()) * self.pose.rotation;
        self.com += by.fixed_rows::<3>(0);
        self.turn_to(rotation);
        self.shift += by;
    }

    pub(super) fn spin_about(&self, axis: &Vector3<f64>, world: &World) -> Option<Spin> {
        let rigid = world.bodies.get(self.rigid).filter(|_| self.moves())?;
        let spin = Vector3::from(from_vector(rigid.angvel()));
        let about = axis * spin.dot(axis);
        Some(Spin { about, rest: spin - about }).filter(|_| spin.iter().all(|x| x.is_finite()))
    }

    /// Turns about the centre of mass.
    pub(super) fn turn_to(&mut self, rotation: UnitQuaternion<f64>) {
        self.pose = Pose::from_parts((self.com - rotation * self.com_in_shape).into(), rotation);
    }

    /// Where the body is, to be taken back there.
    pub(super) fn place_now(&self) -> Place {
        Place { pose: self.pose, com: self.com, shift: self.shift }
    }

    pub(super) fn take_back(&mut self, place: Place) {
        (self.pose, self.com, self.shift) = (place.pose, place.com, place.shift);
    }

    /// Tells rapier where the body was shifted to, which makes its velocity another one if that `learns` of it; `most` bounds its spin,
    /// rad/s.
    pub(super) fn tell(&self, world: &mut World, step: f64, learns: bool, most: f64) {
        let Some(rigid) = world.bodies.get_mut(self.rigid) else { return };
        if (self.shift == Vector6::zeros() && self.rotor.is_none()) || !is_finite(&self.pose) {
            return;
        }
        rigid.set_position(to_pose(&self.pose), false);
        let learnt = if learns { self.shift } else { Vector6::zeros() };
        let [linear, angular] = [0, 3].map(|part| to_vector((learnt.fixed_rows::<3>(part) / step).into()));
        rigid.set_linvel(rigid.linvel() + linear, false);
        let gained = self.rotor.as_ref().map_or(Vector3::zeros(), |rotor| rotor.gained);
        let spin = rigid.angvel() + angular + to_vector(gained.into());
        rigid.set_angvel(spin.clamp_length_max(most), false);
    }

    /// Takes back the forces of the links: only those of scripts last for more than a sub-step.
    pub(super) fn forget_links(&self, world: &mut World) {
        if let Some(rigid) = world.bodies.get_mut(self.rigid).filter(|rigid| rigid.is_dynamic()) {
            rigid.reset_forces(false);
            rigid.reset_torques(false);
            rigid.add_force(self.asked[0], false);
            rigid.add_torque(self.asked[1], false);
        }
    }

    /// Velocity of a static body that is moved to its next place.
    fn swept(&self, rigid: &RigidBody, step: f64) -> Vector6<f64> {
        if !rigid.is_kinematic() {
            return Vector6::zeros();
        }
        let next = from_pose(rigid.next_position());
        let shift = next.transform_point(&self.com_in_shape.into()).coords - self.com;
        let turn = (next.rotation * self.pose.rotation.inverse()).scaled_axis();
        spatial(shift, turn) / step
    }

    /// Gives rapier impulses as forces that last a sub-step.
    pub(super) fn give(&self, impulse: &Vector6<f64>, world: &mut World, step: f64) {
        if let Some(rigid) = world.bodies.get_mut(self.rigid) {
            rigid.add_force(to_vector((impulse.fixed_rows::<3>(0) / step).into()), true);
            let turn = impulse.fixed_rows::<3>(3) + self.gyration;
            rigid.add_torque(to_vector((self.as_inert(turn) / step).into()), true);
        }
    }

    /// What does to the body as rapier knows it, with what rapier applies by itself, what `turn` does to one with added inertia.
    fn as_inert(&self, turn: Vector3<f64>) -> Vector3<f64> {
        if self.taut.added().is_none() {
            return turn;
        }
        let by_rapier = self.push.fixed_rows::<3>(3) - self.gyration;
        self.world_inertia() * (self.response.fixed_view::<3, 3>(3, 3) * (turn + by_rapier)) - by_rapier
    }
}
