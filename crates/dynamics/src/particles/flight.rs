//! The way of a particle in a sub-step: it flies, bounces and slides.
//!
//! Between surfaces it is a semi-implicit Euler step, as that of bodies. Its velocity is that in the middle of the sub-step: a bounce happens at the velocity of its moment, so that a
//! ball rises to the square of the restitution of the height whatever the sub-step.

use rapier3d_f64::math::Vector;
use scene::drawing::particles::ParticleStyle;
use scene::drawing::particles::options::Parameter;
use scene::parameters::engine::Engine;

use super::obstacles::{Hit, Obstacle, Surroundings};
use super::{Particle, Pushes, from_vector, to_vector};

/// Largest number of surfaces that a particle meets in a sub-step.
const MAX_HITS: usize = 4;
/// A particle that is not faster than what it gains in so many sub-steps does not bounce: it rests.
const STEPS_OF_REST: f64 = 2.0;

/// Friction and restitution of particles.
#[derive(Clone, Copy)]
pub(super) struct Touch {
    pub friction: f64,
    pub restitution: f64,
    /// Whether the larger of two frictions counts, not their product.
    is_largest: bool,
}

impl Touch {
    /// What the selected engine reads of the parameters; MuJoCo, which has no particles, reads Bullet's.
    pub(super) fn new(style: &ParticleStyle, engine: Engine) -> Self {
        let [friction, restitution] = match engine {
            Engine::Ode => [Some(Parameter::OdeFriction), None],
            Engine::Vortex => [
                Some(Parameter::VortexFriction),
                Some(Parameter::VortexRestitution),
            ],
            Engine::Newton => [
                Some(Parameter::NewtonFriction),
                Some(Parameter::NewtonRestitution),
            ],
            _ => [
                Some(Parameter::BulletFriction),
                Some(Parameter::BulletRestitution),
            ],
        };
        let value = |parameter: Option<Parameter>| {
            parameter.map_or(0.0, |parameter| style.parameters.get(parameter))
        };
        Self {
            friction: value(friction),
            restitution: value(restitution).min(1.0),
            is_largest: engine == Engine::Mujoco,
        }
    }

    fn with(self, obstacle: &Obstacle) -> [f64; 2] {
        let other = obstacle.collider.friction();
        let friction = if self.is_largest {
            self.friction.max(other)
        } else {
            self.friction * other
        };
        let restitution = self.restitution * obstacle.collider.restitution();
        [friction, restitution.clamp(0.0, 1.0)]
    }
}

/// A particle on its way.
struct Flight<'a> {
    at: Vector,
    /// In the middle of the sub-step.
    velocity: Vector,
    acceleration: Vector,
    /// Part of the sub-step that is over.
    gone: f64,
    step: f64,
    radius: f64,
    mass: f64,
    touch: Touch,
    pushes: &'a mut Pushes,
}

/// Moves a particle with nothing in its way.
pub(super) fn fly_freely(particle: &mut Particle, acceleration: Vector, step: f64) {
    let velocity = to_vector(particle.velocity) + acceleration * step;
    particle.velocity = from_vector(velocity);
    particle.position = from_vector(to_vector(particle.position) + velocity * step);
}

/// Moves a particle among obstacles.
pub(super) fn fly(
    particle: &mut Particle,
    acceleration: Vector,
    around: &Surroundings,
    touch: Touch,
    pushes: &mut Pushes,
) {
    let mut flight = Flight {
        at: to_vector(particle.position),
        velocity: to_vector(particle.velocity) + acceleration * around.step,
        acceleration,
        gone: 0.0,
        step: around.step,
        radius: particle.size / 2.0,
        mass: particle.mass,
        touch,
        pushes,
    };
    flight.go(around);
    flight.leave(around);
    particle.position = from_vector(flight.at);
    particle.velocity = from_vector(flight.velocity);
}

impl Flight<'_> {
    /// The velocity at a moment of the sub-step, 0 to 1.
    fn velocity_at(&self, moment: f64) -> Vector {
        self.velocity + self.acceleration * self.step * (moment - 0.5)
    }

    fn go(&mut self, around: &Surroundings) {
        for _ in 0..MAX_HITS {
            let rest = 1.0 - self.gone;
            let way = self.velocity_at(f64::midpoint(1.0, self.gone)) * self.step * rest;
            let Some(hit) = self.first(around, way) else {
                self.at += way;
                return;
            };
            self.at += way * hit.part;
            self.gone += rest * hit.part;
            self.bounce(&hit.obstacle, hit.normal);
        }
    }

    fn first<'w>(&self, around: &Surroundings<'w>, way: Vector) -> Option<Hit<'w>> {
        let obstacles = around.on_way(self.at, way, self.radius).into_iter();
        obstacles
            .filter_map(|obstacle| obstacle.hit(self.at, way, self.radius))
            .min_by(|a, b| a.part.total_cmp(&b.part))
    }

    fn bounce(&mut self, obstacle: &Obstacle, normal: Vector) {
        let surface = self.surface_velocity(obstacle, normal);
        let relative = self.velocity_at(self.gone) - surface;
        let slow = STEPS_OF_REST * self.acceleration.length() * self.step;
        let [friction, restitution] = self.touch.with(obstacle);
        if -relative.dot(normal) <= slow {
            self.rest(obstacle, normal, friction);
        } else {
            self.change(obstacle, normal, relative, [friction, restitution]);
        }
    }

    /// The surface takes what goes into it, of the velocity and of what accelerates.
    fn rest(&mut self, obstacle: &Obstacle, normal: Vector, friction: f64) {
        let relative = self.velocity - self.surface_velocity(obstacle, normal);
        if relative.dot(normal) < 0.0 {
            self.change(obstacle, normal, relative, [friction, 0.0]);
        }
        self.acceleration -= normal * self.acceleration.dot(normal).min(0.0);
    }

    /// Exchanges momentum with what the particle touches, to which it has that velocity.
    fn change(
        &mut self,
        obstacle: &Obstacle,
        normal: Vector,
        relative: Vector,
        [friction, restitution]: [f64; 2],
    ) {
        let approach = -relative.dot(normal);
        let gain = (1.0 + restitution) * approach * self.share(obstacle, normal);
        let slip = relative + normal * approach;
        let speed = slip.length();
        let slowed = if speed > 0.0 {
            slip * ((friction * gain).min(speed) / speed)
        } else {
            Vector::ZERO
        };
        let change = normal * gain - slowed;
        self.velocity += change;
        if obstacle.rigid.is_dynamic() {
            let impulse = change * -self.mass;
            let arm = self.point(normal) - obstacle.rigid.center_of_mass();
            self.pushes.add(obstacle.body, impulse, arm.cross(impulse));
        }
    }

    /// Which part of a change of velocity is the particle's, where a body gives way.
    fn share(&self, obstacle: &Obstacle, normal: Vector) -> f64 {
        if !obstacle.rigid.is_dynamic() {
            return 1.0;
        }
        let mass = obstacle.rigid.mass_properties();
        let lever = (self.point(normal) - obstacle.rigid.center_of_mass()).cross(normal);
        let turning = lever.dot(mass.effective_world_inv_inertia * lever);
        1.0 / (1.0 + self.mass * (mass.effective_inv_mass.x + turning))
    }

    /// Velocity of a body where the particle touches it, after what particles have done to it in this sub-step.
    fn surface_velocity(&self, obstacle: &Obstacle, normal: Vector) -> Vector {
        let (rigid, point) = (obstacle.rigid, self.point(normal));
        let velocity = rigid.velocity_at_point(point);
        if !rigid.is_dynamic() {
            return velocity;
        }
        let [impulse, moment] = self.pushes.of(obstacle.body);
        let mass = rigid.mass_properties();
        let turn = mass.effective_world_inv_inertia * moment;
        let arm = point - rigid.center_of_mass();
        velocity + impulse * mass.effective_inv_mass.x + turn.cross(arm)
    }

    fn point(&self, normal: Vector) -> Vector {
        self.at - normal * self.radius
    }

    /// Leaves what has come too near: bodies that moved, and corners.
    fn leave(&mut self, around: &Surroundings) {
        for obstacle in around.on_way(self.at, Vector::ZERO, self.radius) {
            let Some(near) = obstacle.nearest(self.at) else {
                continue;
            };
            if near.distance >= self.radius {
                continue;
            }
            self.at += near.normal * (self.radius - near.distance);
            let [friction, _] = self.touch.with(&obstacle);
            self.rest(&obstacle, near.normal, friction);
        }
    }
}
