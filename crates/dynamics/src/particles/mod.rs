//! Particles: small spheres that scripts emit (spec: dynamics 12). A light step of its own, after that of the bodies: they fall, are slowed down, bounce and slide, and push bodies.
//!
//! - here: which of them move, drag, what they do to bodies.
//! - `flight`: the way of one among what is around; `obstacles`: what that is; `pairs`: particles that collide with each other.
//!
//! The particles are the scene's. They do not turn; scripts are not asked about their contacts.

mod flight;
mod obstacles;
mod pairs;

use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::RigidBodyHandle;
use scene::Scene;
use scene::drawing::particles::options::{Parameter, ParticleFlags};
use scene::drawing::particles::{Particle, ParticleObject, ParticleStyle};
use scene::parameters::engine::Engine;
use std::collections::BTreeMap;

use super::bodies::{Bodies, Tag};
use super::convert::{from_vector, to_vector};
use super::world::World;
use flight::Touch;
use obstacles::Surroundings;

/// Particles further away from the origin than this are gone, metres.
const RANGE: f64 = 1000.0;

/// What particles do to bodies, and whether anybody sees them.
#[derive(Default)]
pub(super) struct Particles {
    pushes: Pushes,
    /// Whether bodies have been pushed in this sub-step.
    pub have_pushed: bool,
    /// Whether nobody outside of scripts looks: what only looks would show need not move.
    pub are_unseen: bool,
}

/// Impulses on bodies that are to act in the next sub-step, with their moments about the centre of mass: N s, N m s.
#[derive(Default)]
pub(super) struct Pushes(BTreeMap<RigidBodyKey, [Vector; 2]>);

/// A body, in the order of its number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct RigidBodyKey(u32, u32);

/// What holds for all particles in a sub-step.
#[derive(Clone, Copy)]
struct Moment {
    gravity: Vector,
    engine: Engine,
    /// Seconds.
    step: f64,
}

impl Particles {
    /// Those of a new run.
    pub(super) fn anew(&self) -> Self {
        Self {
            are_unseen: self.are_unseen,
            ..Self::default()
        }
    }

    /// Lets the impulses of the last sub-step act in this one of `step` seconds.
    pub(super) fn push(&mut self, world: &mut World, step: f64) {
        let pushes = std::mem::take(&mut self.pushes.0);
        self.have_pushed = !pushes.is_empty();
        for (body, [impulse, moment]) in pushes {
            if let Some(rigid) = world.bodies.get_mut(body.handle()) {
                rigid.add_force(impulse / step, true);
                rigid.add_torque(moment / step, true);
            }
        }
    }

    /// Moves the particles of the scene by a sub-step of `step` seconds, among the bodies at its end.
    pub(super) fn advance(
        &mut self,
        scene: &mut Scene,
        bodies: &Bodies,
        world: &World,
        gravity: Vector,
        step: f64,
    ) {
        if scene.drawings().particles().is_empty() {
            return;
        }
        let now = Moment {
            gravity,
            engine: scene.settings().dynamics.engine.engine,
            step,
        };
        for object in scene.drawings_mut().particles_mut().iter_mut() {
            if object.items().len() > 0 {
                if self.is_of_use(object.style(), bodies) {
                    move_all(object, world, now, &mut self.pushes);
                }
                object.age(step, is_lost);
            }
        }
    }

    /// Whether it makes a difference where the particles are: vision sensors may see them, bodies may be pushed, or somebody looks.
    fn is_of_use(&self, style: &ParticleStyle, bodies: &Bodies) -> bool {
        let pushes = |mask: u8| {
            let mut bodies = bodies.iter();
            mask != 0 && bodies.any(|(_, body)| body.is_pushed_by(mask))
        };
        let is_hidden = style.flags.contains(ParticleFlags::INVISIBLE);
        let is_looked_at = !self.are_unseen || style.flags.contains(ParticleFlags::PAINT_TAG);
        is_looked_at && !is_hidden || pushes(style.flags.mask())
    }
}

impl Pushes {
    fn of(&self, body: RigidBodyHandle) -> [Vector; 2] {
        let of = self.0.get(&RigidBodyKey::new(body));
        of.copied().unwrap_or([Vector::ZERO; 2])
    }

    /// What is no number is left out: a body would be stopped by it.
    fn add(&mut self, body: RigidBodyHandle, impulse: Vector, moment: Vector) {
        if !impulse.is_finite() || !moment.is_finite() {
            return;
        }
        let sum = self.0.entry(RigidBodyKey::new(body));
        let sum = sum.or_insert([Vector::ZERO; 2]);
        sum[0] += impulse;
        sum[1] += moment;
    }
}

impl RigidBodyKey {
    fn new(body: RigidBodyHandle) -> Self {
        let (index, generation) = body.into_raw_parts();
        Self(index, generation)
    }

    fn handle(self) -> RigidBodyHandle {
        RigidBodyHandle::from_raw_parts(self.0, self.1)
    }
}

fn move_all(object: &mut ParticleObject, world: &World, now: Moment, pushes: &mut Pushes) {
    let style = object.style().clone();
    let touch = Touch::new(&style, now.engine);
    let items = object.items_mut();
    let around = Surroundings::of(items, style.flags.mask(), world, now.step);
    for particle in items.iter_mut() {
        let acceleration = acceleration(&style, particle, now);
        match &around {
            Some(around) => flight::fly(particle, acceleration, around, touch, pushes),
            None => flight::fly_freely(particle, acceleration, now.step),
        }
    }
    if style.flags.contains(ParticleFlags::PARTICLE_RESPONDABLE) {
        pairs::collide(items, touch);
    }
}

/// Gravity and drag, as the mean over the sub-step: the drag is that at its end, so that none is too strong.
fn acceleration(style: &ParticleStyle, particle: &Particle, now: Moment) -> Vector {
    let is_water = style.flags.contains(ParticleFlags::WATER);
    let is_below = particle.position[2] < 0.0;
    let is_borne = style.flags.contains(ParticleFlags::IGNORES_GRAVITY) || is_water && is_below;
    let pull = if is_borne { Vector::ZERO } else { now.gravity };
    let drags = if is_water && !is_below {
        [Parameter::LinearDragInAir, Parameter::QuadraticDragInAir]
    } else {
        [Parameter::LinearDrag, Parameter::QuadraticDrag]
    };
    let [linear, quadratic] = drags.map(|drag| style.parameters.get(drag));
    let velocity = to_vector(particle.velocity);
    let rate = (linear + quadratic * velocity.length()) / particle.mass;
    let after = (velocity + pull * now.step) / (1.0 + rate * now.step);
    (after - velocity) / now.step
}

fn is_lost(particle: &Particle) -> bool {
    let is_near = |x: &f64| x.abs() <= RANGE;
    let is_finite = particle.velocity.iter().all(|x| x.is_finite());
    !is_finite || !particle.position.iter().all(is_near)
}
