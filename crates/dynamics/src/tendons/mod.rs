//! Tendons, as MuJoCo's: a spring, a damper, dry friction, actuators and a smallest and largest length along straight lines from point to point, and over joints.
//!
//! Where all that moves belongs to one mechanism, the force is found together with its joints (`mechanisms::linked`). Elsewhere it is found from the bodies as if nothing else held them, so
//! that no spring is too stiff for a free body.

mod pull;

use nalgebra::Vector6;
use rapier3d_f64::math::{Pose as EnginePose, Vector};
use rapier3d_f64::prelude::RigidBody;
use scene::joint::Actuators;
use scene::{Handle, Scene, Uid};

use super::actuators::acting;
use super::bodies::Bodies;
use super::convert::{from_vector, to_vector};
use super::links::Links;
use super::motors::Motion;
use super::plan::TendonPlan;
use super::world::World;
use articulation::Passive;
pub(super) use pull::Pull;

/// The tendons of a scene.
#[derive(Default)]
pub(super) struct Tendons {
    all: Vec<Tendon>,
    /// Whether bodies have been pulled in this sub-step.
    pub have_pulled: bool,
}

/// A tendon.
pub(super) struct Tendon {
    pub plan: TendonPlan,
    /// Shortest and longest length at which the spring exerts no force.
    rest: [f64; 2],
    /// Targets of its actuators, from scripts: force, length, speed.
    targets: [f64; 3],
    /// Whether a mechanism solves it.
    pub is_linked: bool,
}

/// A tendon as it lies now.
pub(super) struct Layout {
    pub length: f64,
    /// How the length changes with the velocities of bodies: of the centre of mass, and angular.
    pub wrenches: Vec<Wrench>,
}

/// What a tendon with a force of 1 N that lengthens it does to a body.
pub(super) struct Wrench {
    pub body: Handle,
    pub force: Vector,
    /// About the centre of mass.
    pub torque: Vector,
}

impl Tendons {
    /// Makes the tendons those of the plan. The length at the start stays that of the first plan.
    pub(super) fn apply_plan(
        &mut self,
        plan: Vec<TendonPlan>,
        bodies: &Bodies,
        links: &Links,
        world: &World,
    ) {
        let old = std::mem::take(&mut self.all);
        let known = |uid: Uid| old.iter().find(|known| known.plan.uid == uid);
        for plan in plan {
            let known = known(plan.uid);
            let mut tendon = Tendon {
                rest: [0.0; 2],
                targets: [0.0; 3],
                is_linked: false,
                plan,
            };
            let at_start = || [tendon.layout(bodies, links, world).length; 2];
            let rest = tendon.plan.law.rest;
            tendon.rest = rest.unwrap_or_else(|| known.map_or_else(at_start, |known| known.rest));
            self.all.push(tendon);
        }
    }

    /// Reads the targets of actuators that scripts set.
    pub(super) fn read_targets(&mut self, scene: &Scene) {
        for tendon in self.all.iter_mut().filter(|tendon| tendon.is_actuated()) {
            if let Ok(dummy) = scene.object(tendon.plan.dummy) {
                tendon.targets = dummy.tendon_targets();
            }
        }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Tendon> {
        self.all.iter()
    }

    pub(super) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Tendon> {
        self.all.iter_mut()
    }

    /// Pulls at the bodies in a sub-step of `step` seconds, where no mechanism solves the tendon.
    pub(super) fn pull(
        &mut self,
        bodies: &Bodies,
        links: &Links,
        world: &mut World,
        gravity: [f64; 3],
        step: f64,
    ) {
        self.have_pulled = false;
        for tendon in self.all.iter().filter(|tendon| !tendon.is_linked) {
            let layout = tendon.layout(bodies, links, world);
            let free = Free::of(&layout, bodies, world, to_vector(gravity), step);
            let pull = tendon.pull(layout.length, free.rate, step);
            let force = pull.force(free.expected, free.mobility);
            for wrench in &layout.wrenches {
                self.have_pulled |= wrench.push(force, bodies, world);
            }
        }
    }
}

impl Tendon {
    fn is_actuated(&self) -> bool {
        self.plan.actuators.iter().next().is_some()
    }

    /// What acts along it over a step of `step` seconds that begins with that length and rate.
    pub(super) fn pull(&self, length: f64, rate: f64, step: f64) -> Pull {
        let law = &self.plan.law;
        let rest = length.max(self.rest[0]).min(self.rest[1]);
        let is_stretched = rest != length || self.rest[0] == self.rest[1];
        let passive = Passive {
            armature: law.armature,
            stiffness: if is_stretched { law.stiffness } else { 0.0 },
            rest,
            damping: law.damping,
            friction: law.friction,
            effort: 0.0,
        };
        let now = Motion {
            position: length,
            velocity: rate,
        };
        let actuators: &Actuators = &self.plan.actuators;
        let (passive, _) = acting(passive, actuators, self.targets, now);
        Pull::new(&passive, law.range, now, step)
    }

    /// Its length, and how that changes.
    pub(super) fn layout(&self, bodies: &Bodies, links: &Links, world: &World) -> Layout {
        let rigid = |body: Option<Handle>| rigid_of(body, bodies, world);
        let places: Vec<Vector> = (self.plan.points.iter())
            .map(|point| {
                let frame = rigid(point.body).map_or(EnginePose::IDENTITY, |body| *body.position());
                frame * to_vector(point.place)
            })
            .collect();
        let mut layout = Layout {
            length: self.length_of_joints(links),
            wrenches: Vec::new(),
        };
        for segment in &self.plan.segments {
            let [first, second] = segment.ends;
            let between = places[second] - places[first];
            layout.length += segment.weight * between.length();
            let Some(along) = between.try_normalize() else {
                continue;
            };
            for (end, sign) in [(first, -segment.weight), (second, segment.weight)] {
                let body = self.plan.points[end].body;
                if let (Some(body), Some(rigid)) = (body, rigid(body)) {
                    let lever = places[end] - rigid.center_of_mass();
                    layout.add(body, along * sign, lever);
                }
            }
        }
        layout
    }

    fn length_of_joints(&self, links: &Links) -> f64 {
        let joints = self.plan.joints.iter();
        let lengths = joints.map(|part| {
            let link = links.get(part.joint);
            part.factor * link.map_or(part.position, |link| link.motion.position)
        });
        lengths.sum()
    }
}

impl Layout {
    /// How fast the tendon gets longer by some of its bodies, m/s.
    pub(super) fn rate_of(
        &self,
        bodies: &Bodies,
        world: &World,
        counts: impl Fn(Handle) -> bool,
    ) -> f64 {
        let counting = self.wrenches.iter().filter(|wrench| counts(wrench.body));
        let rates = counting.filter_map(|wrench| {
            let rigid = rigid_of(Some(wrench.body), bodies, world)?;
            Some(wrench.rate(rigid))
        });
        rates.sum()
    }

    fn add(&mut self, body: Handle, force: Vector, lever: Vector) {
        let torque = lever.cross(force);
        match self.wrenches.iter_mut().find(|wrench| wrench.body == body) {
            Some(wrench) => {
                wrench.force += force;
                wrench.torque += torque;
            }
            None => self.wrenches.push(Wrench {
                body,
                force,
                torque,
            }),
        }
    }
}

impl Wrench {
    /// The same as a spatial vector.
    pub(super) fn spatial(&self) -> Vector6<f64> {
        articulation::spatial(
            from_vector(self.force).into(),
            from_vector(self.torque).into(),
        )
    }

    /// How fast the tendon gets longer by the velocity of the body.
    fn rate(&self, rigid: &RigidBody) -> f64 {
        self.force.dot(rigid.linvel()) + self.torque.dot(rigid.angvel())
    }

    /// Whether there is a body to push.
    fn push(&self, force: f64, bodies: &Bodies, world: &mut World) -> bool {
        let rigid = bodies
            .get(self.body)
            .and_then(|body| world.bodies.get_mut(body.rigid));
        let moving = rigid.filter(|rigid| rigid.is_dynamic() && force.is_finite());
        let Some(rigid) = moving.filter(|_| force != 0.0) else {
            return false;
        };
        rigid.add_force(self.force * force, true);
        rigid.add_torque(self.torque * force, true);
        true
    }
}

/// How a tendon changes whose bodies nothing else holds.
#[derive(Default)]
struct Free {
    /// At the begin of the sub-step, m/s.
    rate: f64,
    /// At its end, without the tendon, m/s.
    expected: f64,
    /// How much more for each newton.
    mobility: f64,
}

impl Free {
    fn of(layout: &Layout, bodies: &Bodies, world: &World, gravity: Vector, step: f64) -> Self {
        let mut free = Self::default();
        for wrench in &layout.wrenches {
            let Some(rigid) = rigid_of(Some(wrench.body), bodies, world) else {
                continue;
            };
            free.rate += wrench.rate(rigid);
            if !rigid.is_dynamic() {
                continue;
            }
            let mass = rigid.mass_properties();
            let (inverse, turning) = (mass.effective_inv_mass.x, mass.effective_world_inv_inertia);
            let falls = gravity * rigid.gravity_scale() + rigid.user_force() * inverse;
            let turns = turning * rigid.user_torque();
            free.expected += (wrench.force.dot(falls) + wrench.torque.dot(turns)) * step;
            let response = wrench.force.dot(wrench.force) * inverse
                + wrench.torque.dot(turning * wrench.torque);
            free.mobility += response * step;
        }
        free.expected += free.rate;
        free
    }
}

fn rigid_of<'w>(body: Option<Handle>, bodies: &Bodies, world: &'w World) -> Option<&'w RigidBody> {
    world.bodies.get(bodies.get(body?)?.rigid)
}
