//! Tendons between two dummies, as MuJoCo's: a spring with a damper along the line between them, with a smallest and a largest length.
//!
//! The force is found from the bodies as if nothing else held them, so that no spring is too stiff for a free body; a limit gives way where bodies are held by joints, until it has
//! stopped them.

use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::prelude::RigidBody;
use scene::parameters::mujoco::Tendon;
use scene::{Handle, Uid};

use super::bodies::Bodies;
use super::convert::to_vector;
use super::plan::TendonPlan;
use super::world::World;

/// The tendons of a scene.
#[derive(Default)]
pub(super) struct Tendons {
    all: Vec<Placed>,
    /// Whether bodies have been pulled in this sub-step.
    pub have_pulled: bool,
}

struct Placed {
    plan: TendonPlan,
    /// Length at which the spring exerts no force, metres.
    rest: f64,
}

/// An end of a tendon.
struct End {
    body: Option<Handle>,
    place: Vector,
    velocity: Vector,
    /// Velocity that gravity and other forces add in a sub-step.
    fall: Vector,
    /// Velocity along the line that an impulse of 1 N s along it adds.
    mobility: f64,
}

impl Tendons {
    /// Makes the tendons those of the plan. The length at the start stays that of the first plan.
    pub(super) fn apply_plan(&mut self, plan: Vec<TendonPlan>, bodies: &Bodies, world: &World) {
        let old = std::mem::take(&mut self.all);
        let known = |uid: Uid| old.iter().find(|known| known.plan.uid == uid);
        for plan in plan {
            let length = plan.length(bodies, world);
            let at_start = known(plan.uid).map_or(length, |known| known.rest);
            let rest = plan.tendon.rest.unwrap_or(at_start);
            self.all.push(Placed { plan, rest });
        }
    }

    /// Pulls at the bodies in a sub-step of `step` seconds.
    pub(super) fn pull(
        &mut self,
        bodies: &Bodies,
        world: &mut World,
        gravity: [f64; 3],
        step: f64,
    ) {
        self.have_pulled = false;
        for placed in &self.all {
            let [first, second] = placed.plan.places(bodies, world);
            let Some(along) = (second - first).try_normalize() else {
                continue;
            };
            let ends = [(0, first), (1, second)].map(|(end, place)| {
                let body = placed.plan.ends[end].body;
                let rigid = rigid_of(body, bodies, world);
                End::new(body, rigid, [place, along], to_vector(gravity), step)
            });
            let length = (second - first).length();
            let tension = placed.tension(&ends, along, length, step);
            for (end, sign) in ends.iter().zip([1.0, -1.0]) {
                self.have_pulled |= end.push(along * (tension * sign), bodies, world);
            }
        }
    }
}

impl TendonPlan {
    /// Where its ends are in the world.
    fn places(&self, bodies: &Bodies, world: &World) -> [Vector; 2] {
        [0, 1].map(|end| {
            let end = &self.ends[end];
            let rigid = rigid_of(end.body, bodies, world);
            let frame = rigid.map_or(EnginePose::IDENTITY, |rigid| *rigid.position());
            frame * to_vector(end.place)
        })
    }

    fn length(&self, bodies: &Bodies, world: &World) -> f64 {
        let [first, second] = self.places(bodies, world);
        (second - first).length()
    }
}

impl Placed {
    /// The force that pulls the ends together, N. That of the spring is the mean over the sub-step, that of the damper the one at its end.
    fn tension(&self, ends: &[End; 2], along: Vector, length: f64, step: f64) -> f64 {
        let Tendon {
            stiffness,
            damping,
            range,
            ..
        } = self.plan.tendon;
        let mobility = ends[0].mobility + ends[1].mobility;
        if mobility <= 0.0 {
            return 0.0;
        }
        let rate = (ends[1].velocity - ends[0].velocity).dot(along);
        let falling = (ends[1].fall - ends[0].fall).dot(along);
        let stretch = length - self.rest + falling * step / 4.0;
        let free = stiffness * stretch + damping * (rate + falling);
        let implicit = (damping * step + stiffness * step * step / 4.0) * mobility;
        let tension = free / (1.0 + implicit);
        let there = length + (rate + falling - tension * step * mobility) * step;
        let beyond = range.map_or(0.0, |[low, high]| there - there.max(low).min(high));
        tension + beyond / (step * step * mobility)
    }
}

impl End {
    fn new(
        body: Option<Handle>,
        rigid: Option<&RigidBody>,
        [place, along]: [Vector; 2],
        gravity: Vector,
        step: f64,
    ) -> Self {
        let moving = rigid.filter(|rigid| rigid.is_dynamic());
        let fall = moving.map(|rigid| acceleration(rigid, place, gravity) * step);
        Self {
            body,
            place,
            velocity: rigid.map_or(Vector::ZERO, |rigid| rigid.velocity_at_point(place)),
            fall: fall.unwrap_or(Vector::ZERO),
            mobility: moving.map_or(0.0, |rigid| mobility(rigid, place, along)),
        }
    }

    /// Whether there is a body to push.
    fn push(&self, force: Vector, bodies: &Bodies, world: &mut World) -> bool {
        let rigid = self.body.and_then(|body| bodies.get(body));
        let rigid = rigid.and_then(|body| world.bodies.get_mut(body.rigid));
        let moving = rigid.filter(|rigid| rigid.is_dynamic() && force.is_finite());
        let Some(rigid) = moving.filter(|_| force != Vector::ZERO) else {
            return false;
        };
        rigid.add_force_at_point(force, self.place, true);
        true
    }
}

fn rigid_of<'w>(body: Option<Handle>, bodies: &Bodies, world: &'w World) -> Option<&'w RigidBody> {
    world.bodies.get(bodies.get(body?)?.rigid)
}

/// What gravity and forces do at a point of a body that nothing holds.
fn acceleration(rigid: &RigidBody, place: Vector, gravity: Vector) -> Vector {
    let mass = rigid.mass_properties();
    let turning = mass.effective_world_inv_inertia * rigid.user_torque();
    let along = rigid.user_force() * mass.effective_inv_mass.x;
    gravity * rigid.gravity_scale() + along + turning.cross(place - rigid.center_of_mass())
}

fn mobility(rigid: &RigidBody, place: Vector, along: Vector) -> f64 {
    let mass = rigid.mass_properties();
    let lever = (place - rigid.center_of_mass()).cross(along);
    mass.effective_inv_mass.x + lever.dot(mass.effective_world_inv_inertia * lever)
}
