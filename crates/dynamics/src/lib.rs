//! The scene's physics, by rapier. The only place that names rapier.
//!
//! A dynamics call is divided into sub-steps. [`Dynamics::begin`] brings the engine up to date with the scene, then every sub-step is
//! [`prepare`](Dynamics::prepare) (static bodies and motors), [`start_sub_step`](Dynamics::start_sub_step), [`SubStep::run`] and
//! [`finish_sub_step`](Dynamics::finish_sub_step) (writes the results to the scene), and [`end`](Dynamics::end) closes the call. Between these
//! neither the scene nor the dynamics is borrowed, so scripts may run. During a sub-step the scene may be read and written; the engine
//! reads the changes at the next call.
//!
//! - `sub_step`: the order in which parts of the physics act.
//! - `plan`: the bodies and constraints that the scene needs; compared with those that exist, so that only changes reach the engine.
//! - `bodies`, `links`: the objects of a plan in the engine; `mechanisms`: linked bodies, solved by the crate `articulation`, with their contacts.
//! - `soft_bodies`: ropes, cloths and volumes, moved by the crate `soft` before the mechanisms are solved.
//! - `particles`: small spheres, moved after the bodies.
//! - `adhesion`, `tendons`: forces between bodies that MuJoCo's parameters ask for; `moving_surfaces`: bodies that carry along as belts do.
//! - `near`: what a body may touch in a sub-step; `free_rotation`: bodies that tumble; `fluid`: what slows bodies down.
//! - `contacts`: collision filters; `flat_faces`: contacts without friction; `motors`: the control law; `actuators`: that of MuJoCo.
//! - `load`, `contact_log`: readings; `frozen`: bodies without finite motion.
//!
//! Free bodies at rest fall asleep, which no reading shows. No state outlives the run: the same scene produces the same bytes.

mod actuators;
mod adhesion;
mod bodies;
mod contact_log;
mod contacts;
mod convert;
mod flat_faces;
mod fluid;
mod free_rotation;
mod frozen;
mod links;
mod load;
mod mechanisms;
mod motors;
mod moving_surfaces;
mod near;
mod particles;
mod plan;
mod report;
mod soft_bodies;
mod sub_step;
mod tendons;
#[cfg(test)]
mod tests;
mod world;

use std::collections::BTreeSet;
use std::num::NonZero;
use std::sync::Arc;

pub use bodies::FormMaker;
use bodies::{Bodies, Forms};
pub use contact_log::Contact;
use contact_log::ContactLog;
pub use contacts::{ContactCallback, ContactResponse, Verdicts};
use frozen::Frozen;
use links::Links;
use mechanisms::Mechanisms;
use mechanisms::workers::Workers;
use motors::Motion;
use moving_surfaces::MovingSurfaces;
use particles::Particles;
use plan::{PairRule, Plan};
pub use report::Trigger;
use soft_bodies::SoftBodies;
pub use sub_step::{ScriptAccess, SubStep};
use tendons::Tendons;
use world::World;

use scene::joint::{Joint, JointMode};
use scene::parameters::mujoco::Surrounding;
use scene::{Field, Handle, Mark, Scene, Topics};

/// Changes that can alter bodies and constraints.
const PLANNED: Topics = Topics::TREE.with_fields(&[
    Field::Layer,
    Field::ObjectProperty,
    Field::SpecialProperty,
    Field::ModelProperty,
    Field::Dynamics,
    Field::Geometry,
    Field::Joint,
    Field::Sensor,
    Field::Other,
]);

/// The physics world that belongs to a scene.
#[derive(Default)]
pub struct Dynamics {
    /// None while a sub-step runs. Boxed, since it is large and moves into every sub-step.
    world: Option<Box<World>>,
    bodies: Bodies,
    links: Links,
    mechanisms: Mechanisms,
    soft_bodies: SoftBodies,
    particles: Particles,
    /// Whether bodies that adhere have been pulled in this sub-step.
    have_adhered: bool,
    tendons: Tendons,
    /// What shapes say of pairs.
    pairs: Vec<PairRule>,
    /// For which the plan was made.
    surrounding: Surrounding,
    contacts: ContactLog,
    frozen: Frozen,
    /// Roots too far away to be simulated.
    far: Vec<Handle>,
    /// State of the scene for which the plan was made.
    known: Option<Mark>,
    /// Whether it had changed by more than results when results were told.
    has_missed_changes: bool,
    call: Option<DynamicsCall>,
    workers: Workers,
    /// The forms of meshes.
    forms: Forms,
    /// Whether the engine has made a step since the plan was made: before it does not know new bodies.
    is_stepped: bool,
    /// Whether a joint of the engine depends on one that only the scene moves.
    follows_scene: bool,
}

/// A dynamics call in progress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DynamicsCall {
    /// Number of sub-steps of the call.
    pub sub_steps: u32,
    /// Length of a sub-step, seconds.
    pub step: f64,
}

/// A call requested during another one.
#[derive(Debug, PartialEq)]
pub struct Busy;

/// A joint in callback control: what a script needs to know to answer.
#[derive(Debug, Clone, PartialEq)]
pub struct JointRequest {
    /// The joint.
    pub joint: Handle,
    /// No sub-step has run yet with this joint.
    pub first: bool,
    /// Position, rad or m.
    pub position: f64,
    /// Velocity, rad/s or m/s.
    pub velocity: f64,
    /// Target minus position, the shortest way.
    pub error: f64,
    /// Of the last sub-step, on the parent.
    pub effort: f64,
}

impl Dynamics {
    /// An empty world that is computed on up to `threads` threads, and its forms as `forms` says; neither shows in the results.
    pub fn new(threads: NonZero<usize>, forms: FormMaker) -> Self {
        Self {
            workers: Workers::new(threads),
            forms: Forms::new(forms),
            ..Self::default()
        }
    }

    /// Drops the world; it is rebuilt at the next step.
    pub fn reset(&mut self) {
        *self = Self {
            workers: std::mem::take(&mut self.workers),
            forms: std::mem::take(&mut self.forms),
            particles: self.particles.anew(),
            ..Self::default()
        };
    }

    /// Whether nobody but scripts looks at the scene from now on: what only looks would show is not computed.
    pub fn set_unseen(&mut self, is_unseen: bool) {
        self.particles.are_unseen = is_unseen;
    }

    /// Begins a call that advances `time_step` seconds; None when there is nothing to simulate.
    pub fn begin(
        &mut self,
        scene: &mut Scene,
        time_step: f64,
    ) -> Result<Option<DynamicsCall>, Busy> {
        if self.call.is_some() {
            return Err(Busy);
        }
        self.contacts.clear();
        let settings = &scene.settings().dynamics;
        if !settings.enabled || !time_step.is_finite() || time_step <= 0.0 {
            return Ok(None);
        }
        let sub_steps = settings.sub_steps(time_step);
        self.note_surrounding(settings.surrounding());
        self.update_plan(scene);
        let has_bodies = self.bodies.iter().any(|(_, body)| body.build.dynamic);
        if self.soft_bodies.is_empty() && !has_bodies && scene.drawings().particles().is_empty() {
            return Ok(None);
        }
        self.soft_bodies.follow(scene);
        let world = self.world.get_or_insert_with(Box::default);
        self.bodies.plan_sweeps(world, scene);
        for link in self.links.values_mut() {
            link.efforts.clear();
            link.loads.clear();
        }
        self.call = Some(DynamicsCall {
            sub_steps,
            step: time_step / f64::from(sub_steps),
        });
        Ok(self.call)
    }

    /// What surrounds all bodies is a part of the plan.
    fn note_surrounding(&mut self, surrounding: Surrounding) {
        let before = std::mem::replace(&mut self.surrounding, surrounding);
        if before == surrounding {
            return;
        }
        self.has_missed_changes = true;
        self.bodies.wind = surrounding.wind;
        if let Some(world) = &mut self.world {
            world
                .bodies
                .iter_mut()
                .for_each(|(_, rigid)| rigid.wake_up(true));
        }
    }

    /// Makes a new plan if its inputs have changed.
    fn update_plan(&mut self, scene: &mut Scene) {
        let changed = self.has_new_changes(scene);
        let released = self.frozen.release(scene);
        if !changed
            && !released
            && !self.bodies.were_touched(scene)
            && !links::were_touched(&self.links, scene)
            && !self.soft_bodies.were_touched(scene)
            && !self.far.iter().any(|&root| !plan::is_far(scene, root))
        {
            return;
        }
        let world = self.world.get_or_insert_with(Box::default);
        let known = |shape: Handle, text: &str| self.soft_bodies.known(shape, text);
        let plan = Plan::new(scene, &self.frozen, &known);
        self.far = plan.far;
        self.bodies
            .apply_plan(plan.bodies, world, scene, &mut self.forms);
        links::move_with_joints(&self.links, &plan.links, &self.bodies, world, scene);
        links::apply_plan(&mut self.links, plan.links, &self.bodies, world, scene);
        links::clear_resets(&self.links, scene);
        contacts::note_colliders(world);
        world.surfaces = Arc::new(MovingSurfaces::new(self.bodies.carrying()));
        let_sleep(&self.bodies, &self.links, world);
        self.soft_bodies
            .apply_plan(plan.soft, &self.bodies, world, scene);
        self.tendons
            .apply_plan(plan.tendons, &self.bodies, &self.links, world);
        self.pairs = plan.pairs;
        self.contacts.forget_resting();
        self.is_stepped = false;
        self.mechanisms.rebuild(
            &mut self.links,
            &scene.all_breadth_first(),
            &self.bodies,
            &mut self.tendons,
            world,
        );
        // Changes made here need no new plan.
        self.has_new_changes(scene);
    }

    /// Whether the scene changed since the last call in a way that may need a new plan.
    fn has_new_changes(&mut self, scene: &Scene) -> bool {
        let changed = scene
            .journal()
            .changed_since(self.known.get_or_insert(Mark::new(PLANNED)));
        std::mem::take(&mut self.has_missed_changes) || changed
    }

    /// Tells the scene where soft bodies are, which is no change that needs a new plan.
    fn report_soft_bodies(&mut self, scene: &mut Scene) {
        if self.soft_bodies.is_empty() {
            return;
        }
        let changed = self.has_new_changes(scene);
        self.soft_bodies.report(scene);
        self.has_new_changes(scene);
        self.has_missed_changes = changed;
    }

    /// Before sub-step number `sub_step` (from 1): moves the static bodies and sets the motors. Returns the joints only a script can drive.
    pub fn prepare(&mut self, scene: &Scene, sub_step: u32) -> Vec<JointRequest> {
        let (Some(world), Some(call)) = (self.world.as_mut(), self.call) else {
            return Vec::new();
        };
        detect_new(&self.bodies, &self.mechanisms, world, gravity_of(scene));
        self.bodies.sweep(
            f64::from(sub_step) / f64::from(call.sub_steps),
            call.step,
            world,
        );
        self.tendons.read_targets(scene);
        let settings = &scene.settings().dynamics;
        let (engine, surrounding) = (settings.engine.engine, settings.surrounding());
        let (mut requests, mut dependent) = (Vec::new(), Vec::new());
        for (handle, link) in self.links.iter_mut() {
            let Ok(joint) = scene.object(handle).and_then(|object| object.joint()) else {
                continue;
            };
            if joint.mode == JointMode::Dependent {
                dependent.push((handle, joint));
                continue;
            }
            if !surrounding.has_motors {
                link.passive = actuators::beside(link.actuation);
                link.set_drive(None, world);
                continue;
            }
            if joint.control.calls_script() {
                requests.push(request(handle, joint, link));
            }
            link.set_orders(joint, engine, call.step, world);
        }
        self.follows_scene = false;
        for (handle, joint) in dependent {
            self.follows_scene |= joint
                .dependency
                .is_some_and(|law| !self.links.contains(law.master));
            let master = master_of(scene, joint, &self.links);
            let Some(link) = self.links.get_mut(handle) else {
                continue;
            };
            link.passive = actuators::beside(link.actuation);
            let drive = master
                .filter(|_| surrounding.has_equalities)
                .and_then(|master| motors::coupled_drive(joint, link.motion, master, call.step));
            link.set_drive(drive, world);
        }
        requests
    }

    /// Sets the motor of a joint in callback control to the result of its script.
    pub fn drive(&mut self, joint: Handle, velocity: Option<f64>, force: Option<f64>) {
        if let (Some(link), Some(world)) = (self.links.get_mut(joint), self.world.as_mut()) {
            link.set_drive(motors::answered(velocity, force), world);
        }
    }

    /// The pairs of shapes that may touch in the next sub-step, as far as they are known.
    pub fn pairs_near(&self) -> Vec<(Handle, Handle)> {
        let Some((world, call)) = self.world.as_deref().zip(self.call) else {
            return Vec::new();
        };
        let mut pairs = contacts::pairs_near(world, call.step);
        pairs.extend(self.soft_bodies.pairs_near(world, call.step));
        pairs
    }

    /// Whether the engine holds this shape, joint or force sensor.
    pub fn simulates(&self, object: Handle) -> bool {
        self.bodies.get(object).is_some()
            || self
                .links
                .get(object)
                .is_some_and(|link| link.plan.kind != plan::LinkKind::Weld)
    }

    /// Shapes that had to be stopped since this was last asked: their motion was no longer one of numbers.
    pub fn take_frozen(&mut self) -> Vec<Handle> {
        self.frozen.take_unreported()
    }

    /// The contacts of the last call, in the order of its sub-steps.
    pub fn contacts(&self) -> impl Iterator<Item = Contact> {
        self.contacts.iter()
    }

    /// The shapes that touched each other in the last sub-step of the last call, the smaller handle first.
    pub fn touching(&self) -> BTreeSet<[Handle; 2]> {
        let contacts: Vec<_> = self.contacts().collect();
        let last = contacts.last().map(|contact| contact.sub_step);
        let of_last = contacts
            .iter()
            .filter(|contact| Some(contact.sub_step) == last);
        of_last
            .map(|contact| contact.shapes)
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect()
    }
}

/// Finds what new bodies touch, so that their first contacts are solved as all others are. Bodies of mechanisms begin to touch in the second sub-step.
fn detect_new(bodies: &Bodies, mechanisms: &Mechanisms, world: &mut World, gravity: [f64; 3]) {
    let is_new = std::mem::take(&mut world.has_new_colliders);
    let mut moving = bodies.iter().filter(|(_, body)| body.build.dynamic);
    if is_new && moving.any(|(shape, _)| !mechanisms.contains(shape)) {
        let rules =
            contacts::Rules::new(None, Verdicts::default(), &[], Arc::clone(&world.surfaces));
        world.detect_collisions(convert::to_vector(gravity), &rules);
    }
}

/// Gravity of the scene, m/s2; none where it is no number.
fn gravity_of(scene: &Scene) -> [f64; 3] {
    let settings = &scene.settings().dynamics;
    let gravity = settings.gravity.map(f64::from);
    if settings.surrounding().has_gravity && gravity.iter().all(|x| x.is_finite()) {
        gravity
    } else {
        [0.0; 3]
    }
}

/// Bodies with links stay awake.
fn let_sleep(bodies: &Bodies, links: &Links, world: &mut World) {
    let linked: BTreeSet<Handle> = links
        .iter()
        .flat_map(|(_, link)| [link.plan.first, link.plan.second])
        .collect();
    bodies.let_sleep(world, |shape| linked.contains(&shape));
}

/// Where the master of a joint is; one that nothing in the physics hangs on stands where the scene has it.
fn master_of(scene: &Scene, joint: &Joint, links: &Links) -> Option<Motion> {
    let master = joint.dependency?.master;
    links.get(master).map(|link| link.motion).or_else(|| {
        let joint = scene.object(master).ok()?.joint().ok()?;
        Some(Motion {
            position: joint.position,
            velocity: 0.0,
        })
    })
}

fn request(handle: Handle, joint: &Joint, link: &links::Link) -> JointRequest {
    JointRequest {
        joint: handle,
        first: link.fresh,
        position: link.motion.position,
        velocity: link.motion.velocity,
        error: joint.position_error(link.motion.position),
        effort: link.efforts.last().copied().unwrap_or(0.0),
    }
}
