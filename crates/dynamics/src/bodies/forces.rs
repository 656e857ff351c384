//! Forces of scripts and of fluids on bodies.

use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::RigidBody;
use scene::Scene;
use scene::shape::Shape;

use super::{Bodies, Body};
use crate::convert::to_vector;
use crate::fluid::drag;
use crate::world::World;

impl Bodies {
    /// Applies the forces of scripts, of fluids and of what compensates gravity, in place of those of the last sub-step of `step` seconds. rapier processes every body that was changed, so
    /// bodies without forces are left alone.
    pub(crate) fn apply_forces(
        &self,
        world: &mut World,
        scene: &Scene,
        gravity: [f64; 3],
        step: f64,
    ) {
        for (shape, body) in self.iter().filter(|(_, body)| body.build.dynamic) {
            let Ok(shape) = scene.object(shape).and_then(|object| object.shape()) else {
                continue;
            };
            let Some(rigid) = world.bodies.get(body.rigid) else {
                continue;
            };
            let of_script = script_forces(shape);
            let of_fluid = body.fluid_forces(rigid, self.wind, step);
            let [force, torque] = [0, 1].map(|part| of_script[part] + of_fluid[part]);
            let force = force + body.lift(rigid, gravity);
            let is_forced = force != Vector::ZERO || torque != Vector::ZERO;
            if !is_forced && is_free(rigid) {
                continue;
            }
            if let Some(rigid) = world.bodies.get_mut(body.rigid) {
                let wakes = of_script != [Vector::ZERO; 2];
                rigid.reset_forces(false);
                rigid.reset_torques(false);
                rigid.add_force(force, wakes);
                rigid.add_torque(torque, wakes);
            }
        }
    }
}

impl Body {
    fn fluid_forces(&self, rigid: &RigidBody, wind: [f64; 3], step: f64) -> [Vector; 2] {
        let drag = |fluid| drag(fluid, to_vector(wind), rigid, step);
        self.surface.fluid.map_or([Vector::ZERO; 2], drag)
    }

    /// What compensates a part of its weight.
    fn lift(&self, rigid: &RigidBody, gravity: [f64; 3]) -> Vector {
        match self.surface.gravity_compensation {
            0.0 => Vector::ZERO,
            part => to_vector(gravity) * (-part * rigid.mass()),
        }
    }
}

/// Force and torque that scripts ask for; none if they are no numbers.
fn script_forces(shape: &Shape) -> [Vector; 2] {
    let forces = [shape.force, shape.torque].map(to_vector);
    if forces.iter().all(|force| force.is_finite()) {
        forces
    } else {
        [Vector::ZERO; 2]
    }
}

fn is_free(rigid: &RigidBody) -> bool {
    rigid.user_force() == Vector::ZERO && rigid.user_torque() == Vector::ZERO
}
