//! Static bodies that scripts move: they go along with the scene over a call. Bodies whose surface moves.

use geometry::Finite;
use geometry::pose::interpolate;
use rapier3d_f64::prelude::{RigidBodyHandle, RigidBodyType};
use scene::shape::{MovingSurface, Velocity};
use scene::{Pose, Scene};

use super::{Bodies, Body};
use crate::convert::to_pose;
use crate::world::World;

/// A static body counts as moved when it moved more than this between two calls, metres and radians.
const STATIC_TOLERANCE: (f64, f64) = (1e-5, 0.05 * std::f64::consts::PI / 180.0);
impl Bodies {
    /// The bodies that move while their surface moves along them.
    pub(crate) fn carrying(&self) -> impl Iterator<Item = (RigidBodyHandle, MovingSurface)> {
        let moving = self.all.iter().filter(|(_, body)| body.build.dynamic);
        moving.filter_map(|(_, body)| Some((body.rigid, body.surface.motion?)))
    }

    /// Whether a static body moves during this call.
    pub(crate) fn are_sweeping(&self) -> bool {
        !self.sweeping.is_empty()
    }

    /// Plans the way of the static bodies over the call: from where the engine has them to where the scene has them.
    pub(crate) fn plan_sweeps(&mut self, world: &mut World, scene: &Scene) {
        self.sweeping.clear();
        for (place, (shape, body)) in self
            .all
            .iter_mut()
            .enumerate()
            .filter(|(_, (_, body))| !body.build.dynamic)
        {
            if let (Some(motion), Ok(pose)) = (body.surface.motion, scene.world_pose(*shape)) {
                body.drift = turned(motion, &pose);
            }
            body.stop_drift(world);
            let (Some(held), Ok(to)) = (body.pose(world), scene.world_pose(*shape)) else {
                continue;
            };
            let from = body.standing.unwrap_or(held);
            let moves = has_moved(&from, &to) || body.drifts();
            body.sweep = (moves && to.is_finite()).then_some((from, to));
            body.standing = body.sweep.filter(|_| body.drifts()).map(|_| from);
            if body.sweep.is_some() {
                self.sweeping.push(place);
                body.let_move(world);
            }
        }
    }

    /// Moves the static bodies to `fraction` of their way, in a sub-step of so many seconds. Those whose surface moves begin where they
    /// stand and go as far as their surface does: contacts only know velocities of bodies.
    pub(crate) fn sweep(&mut self, fraction: f64, step: f64, world: &mut World) {
        for &place in &self.sweeping {
            let Some((_, body)) = self.all.get_mut(place) else {
                continue;
            };
            let (Some((from, to)), Some(rigid)) = (&body.sweep, world.bodies.get_mut(body.rigid))
            else {
                continue;
            };
            let next = interpolate(from, to, fraction);
            let Some(standing) = &mut body.standing else {
                rigid.set_next_kinematic_position(to_pose(&next));
                continue;
            };
            rigid.set_position(to_pose(standing), false);
            rigid.set_next_kinematic_position(to_pose(&drifted(&next, &body.drift, step)));
            *standing = next;
        }
    }
}

impl Body {
    fn drifts(&self) -> bool {
        self.drift != Velocity::default()
            && self
                .drift
                .linear
                .iter()
                .chain(&self.drift.angular)
                .all(|x| x.is_finite())
    }

    /// Puts a body back to where it stands whose surface does not move any more.
    fn stop_drift(&mut self, world: &mut World) {
        if !self.drifts()
            && let Some(standing) = self.standing.take()
            && let Some(rigid) = world.bodies.get_mut(self.rigid)
        {
            rigid.set_position(to_pose(&standing), true);
        }
    }

    /// A static body that begins to move pushes others, and leaves others without support.
    fn let_move(&self, world: &mut World) {
        if let Some(rigid) = world.bodies.get_mut(self.rigid)
            && rigid.is_fixed()
        {
            // rapier wakes what touches the body.
            rigid.set_body_type(RigidBodyType::KinematicPositionBased, true);
        }
    }
}

/// A motion in the frame of a shape, along the axes of the world.
fn turned(motion: MovingSurface, pose: &Pose) -> Velocity {
    let turn = |v: [f64; 3]| (pose.rotation * nalgebra::Vector3::from(v)).into();
    Velocity {
        linear: turn(motion.linear),
        angular: turn(motion.angular),
    }
}

/// Where a body would go with a velocity, seconds later.
fn drifted(pose: &Pose, velocity: &Velocity, seconds: f64) -> Pose {
    let [linear, angular] = [velocity.linear, velocity.angular].map(nalgebra::Vector3::from);
    let shift = nalgebra::Translation3::from(linear * seconds);
    let turn = nalgebra::UnitQuaternion::from_scaled_axis(angular * seconds);
    Pose::from_parts(shift * pose.translation, turn * pose.rotation)
}

/// Whether two places of a static body count as different.
pub(super) fn has_moved(from: &Pose, to: &Pose) -> bool {
    let shift = (to.translation.vector - from.translation.vector).norm();
    shift > STATIC_TOLERANCE.0 || from.rotation.angle_to(&to.rotation) > STATIC_TOLERANCE.1
}
