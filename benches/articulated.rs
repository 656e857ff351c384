//! How chains of joints are solved: here (by both choices of `rapier.solver`), by rapier's impulse joints, and by its multibodies. One table,
//! for docs/PHYSICS.md:
//!
//!     cargo bench --bench articulated
//!
//! All make sub-steps of 5 ms. A chain hangs on the world by hinges; those with a target are driven by CoppeliaSim's law of position
//! control (a tenth of the error per sub-step, 200 N m).

#![allow(clippy::disallowed_methods, reason = "a benchmark asks for the time")]

mod common;

use std::time::{Duration, Instant};

use common::RawWorld;
use rapier3d_f64::prelude::*;
use swanilda::scene::Data;
use swanilda::{Options, ScriptKind, ScriptRef, Simulator};

const STEP: f64 = 0.005;
const PASS: usize = 10;
const G: f64 = 9.81;
const FORCE: f64 = 200.0;
const MAX_SPEED: f64 = std::f64::consts::TAU;

/// A chain of boxes along z or inclined in the plane of x and z; joint i sits at the lower (near) end of box i.
struct Chain {
    name: &'static str,
    seconds: f64,
    length: f64,
    /// From the way up, radians.
    incline: f64,
    masses: Vec<f64>,
    /// Axes about y, and every other one along the chain.
    alternate: bool,
    target: Option<f64>,
}

/// What a run came to: largest error of a driven joint at the end, largest gap of a joint, largest change of the energy by what can
/// fall, time of a sub-step in the fastest iteration (the others tell what else the machine was doing).
struct Outcome {
    error: f64,
    gap: f64,
    energy: f64,
    time: Duration,
}

impl Chain {
    fn direction(&self) -> Vector {
        Vector::new(self.incline.sin(), 0.0, self.incline.cos())
    }

    fn turn(&self) -> Rotation {
        Rotation::from_scaled_axis(Vector::Y * self.incline)
    }

    /// The joint's axis in the frame of its box.
    fn axis(&self, index: usize) -> Vector {
        if self.alternate && index.is_multiple_of(2) {
            Vector::Z
        } else {
            Vector::Y
        }
    }

    /// Both frames whole: multibodies place their links by them.
    fn joint(&self, index: usize) -> GenericJoint {
        let half = Vector::Z * (self.length / 2.0);
        let along = Rotation::from_rotation_arc(Vector::X, self.axis(index));
        let (anchor, turn) = if index == 0 {
            (Vector::ZERO, self.turn())
        } else {
            (half, Rotation::IDENTITY)
        };
        let mut joint = GenericJoint::new(JointAxesMask::LOCKED_REVOLUTE_AXES);
        joint.set_local_frame1(Pose::from_parts(anchor, turn * along));
        joint.set_local_frame2(Pose::from_parts(-half, along));
        joint
    }

    fn sub_steps(&self) -> usize {
        (self.seconds / STEP).round() as usize
    }

    fn fall(&self) -> f64 {
        let reach = |i: usize| self.length * (i as f64 + 0.5) * (1.0 + self.incline.cos());
        self.masses
            .iter()
            .enumerate()
            .map(|(i, mass)| mass * G * reach(i))
            .sum()
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Impulse { iterations: usize },
    Multibody,
}

/// rapier alone.
struct Raw<'a> {
    chain: &'a Chain,
    kind: Kind,
    links: Vec<RigidBodyHandle>,
    impulse: Vec<ImpulseJointHandle>,
    reduced: Vec<MultibodyJointHandle>,
    world: RawWorld,
}

impl<'a> Raw<'a> {
    fn new(chain: &'a Chain, kind: Kind) -> Self {
        let iterations = if let Kind::Impulse { iterations } = kind {
            iterations
        } else {
            4
        };
        let parameters = IntegrationParameters {
            dt: STEP,
            num_solver_iterations: 1,
            num_internal_pgs_iterations: iterations,
            normalized_max_linear_velocity: f64::MAX,
            ..IntegrationParameters::default()
        };
        let world = RawWorld::new(parameters);
        let mut raw = Self {
            chain,
            kind,
            links: Vec::new(),
            impulse: Vec::new(),
            reduced: Vec::new(),
            world,
        };
        raw.build();
        raw
    }

    fn build(&mut self) {
        let chain = self.chain;
        let mut parent = self.world.bodies.insert(RigidBodyBuilder::fixed());
        for (i, &mass) in chain.masses.iter().enumerate() {
            let centre = chain.direction() * (chain.length * (i as f64 + 0.5));
            let pose = Pose::from_parts(centre, chain.turn());
            let half = [0.01, 0.01, chain.length / 2.0];
            let collider = ColliderBuilder::cuboid(half[0], half[1], half[2]).mass(mass);
            let collider = collider.collision_groups(InteractionGroups::none());
            let body = self.world.add(
                RigidBodyBuilder::dynamic().pose(pose).can_sleep(false),
                collider,
            );
            let joint = chain.joint(i);
            match self.kind {
                Kind::Impulse { .. } => self
                    .impulse
                    .push(self.world.joints.insert(parent, body, joint, true)),
                Kind::Multibody => self
                    .reduced
                    .extend(self.world.multibodies.insert(parent, body, joint, true)),
            }
            self.links.push(body);
            parent = body;
        }
        // They are damped by default.
        if let Some((multibody, _)) = self
            .reduced
            .first()
            .and_then(|&joint| self.world.multibodies.get_mut(joint))
        {
            multibody.damping_mut().fill(0.0);
        }
    }

    fn pose(&self, index: Option<usize>) -> Pose {
        index.map_or(Pose::IDENTITY, |index| {
            *self.world.bodies[self.links[index]].position()
        })
    }

    /// Angle of a joint.
    fn angle(&self, index: usize) -> f64 {
        let base = match index {
            0 => self.chain.turn(),
            _ => self.pose(Some(index - 1)).rotation,
        };
        let relative = base.inverse() * self.pose(Some(index)).rotation;
        relative.to_scaled_axis().dot(self.chain.axis(index))
    }

    fn drive(&mut self) {
        let Some(target) = self.chain.target else {
            return;
        };
        for i in 0..self.links.len() {
            let velocity = (0.1 * (target - self.angle(i)) / STEP).clamp(-MAX_SPEED, MAX_SPEED);
            let data =
                match self.kind {
                    Kind::Impulse { .. } => self
                        .world
                        .joints
                        .get_mut(self.impulse[i], true)
                        .map(|joint| &mut joint.data),
                    Kind::Multibody => self.world.multibodies.get_mut(self.reduced[i]).and_then(
                        |(multibody, id)| multibody.link_mut(id).map(|link| &mut link.joint.data),
                    ),
                };
            if let Some(data) = data {
                data.set_motor_model(JointAxis::AngX, MotorModel::AccelerationBased);
                data.set_motor(JointAxis::AngX, 0.0, velocity, 0.0, 1e12);
                data.set_motor_max_force(JointAxis::AngX, FORCE);
            }
        }
    }

    fn gap(&self) -> f64 {
        let half = Vector::Z * (self.chain.length / 2.0);
        let end = |i: usize| {
            if i == 0 {
                Vector::ZERO
            } else {
                self.pose(Some(i - 1)) * half
            }
        };
        (0..self.links.len())
            .map(|i| (self.pose(Some(i)) * -half - end(i)).length())
            .fold(0.0, f64::max)
    }

    fn energy(&self) -> f64 {
        let of = |&link: &RigidBodyHandle| {
            let body = &self.world.bodies[link];
            body.kinetic_energy() + body.mass() * G * body.center_of_mass().z
        };
        self.links.iter().map(of).sum()
    }

    fn step(&mut self) {
        self.drive();
        self.world.step();
    }

    fn run(mut self) -> Outcome {
        let (mut gap, mut energy, mut time) = (0.0_f64, 0.0_f64, Duration::MAX);
        self.step();
        let start = self.energy();
        for _ in 0..self.chain.sub_steps() / PASS {
            let began = Instant::now();
            (0..PASS).for_each(|_| self.step());
            time = time.min(began.elapsed() / PASS as u32);
            gap = largest(gap, self.gap());
            energy = largest(energy, (self.energy() - start).abs());
        }
        let error = |target: f64| {
            (0..self.links.len())
                .map(|i| (self.angle(i) - target).abs())
                .fold(0.0, largest)
        };
        let error = self.chain.target.map_or(0.0, error);
        Outcome {
            error,
            gap,
            energy: energy / self.chain.fall(),
            time,
        }
    }
}

/// Not a number is larger than any.
fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() {
        f64::NAN
    } else {
        a.max(b)
    }
}

/// The same chain in a scene, held by that solver. `report` returns gap, energy and error.
fn scene(chain: &Chain, solver: &str) -> (Simulator, ScriptRef) {
    let masses = chain
        .masses
        .iter()
        .map(f64::to_string)
        .collect::<Vec<_>>()
        .join(",");
    let target = chain
        .target
        .map_or("nil".to_owned(), |target| target.to_string());
    let code = include_str!("articulated.lua")
        .replace("LENGTH", &chain.length.to_string())
        .replace("INCLINE", &chain.incline.to_string())
        .replace("ALTERNATE", &chain.alternate.to_string())
        .replace("TARGET", &target)
        .replace("SOLVER", solver)
        .replace("MASSES", &masses);
    let mut sim = Simulator::new(Options::default());
    let script = sim
        .add_script(ScriptKind::Customization, "chain", code.as_bytes())
        .expect("the scene loads");
    sim.start();
    sim.iterate();
    (sim, script)
}

fn here(chain: &Chain, solver: &str) -> Outcome {
    let (mut sim, script) = scene(chain, solver);
    let (mut gap, mut energy, mut error, mut time) = (0.0_f64, 0.0_f64, 0.0, Duration::MAX);
    let mut start = None;
    for _ in 0..chain.sub_steps() / PASS {
        let began = Instant::now();
        sim.iterate();
        time = time.min(began.elapsed() / PASS as u32);
        let report = sim.call(&script, "report", &[]).expect("the scene reports");
        let [now_gap, now_energy, now_error] =
            [0, 1, 2].map(|i| report.get(i).and_then(Data::as_f64).unwrap_or(f64::NAN));
        let first = *start.get_or_insert(now_energy);
        gap = largest(gap, now_gap);
        energy = largest(energy, (now_energy - first).abs());
        error = now_error;
    }
    Outcome {
        error,
        gap,
        energy: energy / chain.fall(),
        time,
    }
}

fn chains() -> Vec<Chain> {
    let loaded = |count: usize, load: f64| {
        (1..=count)
            .map(|i| if i == count { 0.1 * load } else { 0.1 })
            .collect()
    };
    let swing = |name, masses| Chain {
        name,
        seconds: 10.0,
        length: 0.1,
        incline: 2.6,
        masses,
        alternate: false,
        target: None,
    };
    vec![
        Chain {
            name: "arm of 7 joints, position control",
            seconds: 4.0,
            length: 0.16,
            incline: 0.0,
            masses: (1..=7).map(|i| 2.5 - 0.3 * f64::from(i)).collect(),
            alternate: true,
            target: Some(0.3),
        },
        swing("20 links, swinging", loaded(20, 1.0)),
        swing("20 links with a load 100 times as heavy", loaded(20, 100.0)),
        swing(
            "20 links with a load 1000 times as heavy",
            loaded(20, 1000.0),
        ),
        swing("100 links, swinging", loaded(100, 1.0)),
    ]
}

fn main() {
    // `cargo test --benches` only wants to know that it builds.
    if !std::env::args().any(|argument| argument == "--bench") {
        return;
    }
    println!(
        "| chain | solver | error of the joints, rad | largest gap, m | energy, largest change | sub-step, us |"
    );
    println!("|---|---|---|---|---|---|");
    for chain in chains() {
        let raw = |kind| Raw::new(&chain, kind).run();
        let outcomes = [
            ("Swanilda", here(&chain, "exact")),
            ("Swanilda, `impulse`", here(&chain, "impulse")),
            (
                "impulse joints, 4 iterations",
                raw(Kind::Impulse { iterations: 4 }),
            ),
            (
                "impulse joints, 50 iterations",
                raw(Kind::Impulse { iterations: 50 }),
            ),
            ("multibody", raw(Kind::Multibody)),
        ];
        for (solver, it) in outcomes {
            let error = if chain.target.is_some() {
                format!("{:.1e}", it.error)
            } else {
                String::new()
            };
            let energy = if chain.target.is_some() {
                String::new()
            } else {
                format!("{:.1e}", it.energy)
            };
            let time = it.time.as_secs_f64() * 1e6;
            println!(
                "| {} | {solver} | {error} | {:.0e} | {energy} | {time:.0} |",
                chain.name, it.gap
            );
        }
    }
}
