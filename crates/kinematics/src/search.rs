//! A search for any posture that satisfies a group.
//!
//! Levenberg-Marquardt steps with a damping proportional to the squared error (T. Sugihara, *Solvability-unconcerned inverse kinematics by
//! the Levenberg-Marquardt method*, 2011), joints stopped at their limits, and a random start when an attempt makes poor progress.

use std::f64::consts::{PI, TAU};

use nalgebra::{Quaternion, UnitQuaternion};

use crate::chain::Chains;
use crate::environment::Environment;
use crate::equations::{Angles, Equations, JacobianColumn, exceeds};
use crate::error::Result;
use crate::group::GroupId;
use crate::joint::{Joint, JointType};
use crate::least_squares::{Problem, Scratch};
use crate::object::Object;
use crate::random::Random;

/// Squared damping factor per squared error.
const DAMPING_GAIN: f64 = 0.03;
/// Squared damping factor where there is no error.
const MIN_DAMPING: f64 = 1e-9;
/// Largest number of iterations from one start.
const ITERATIONS_PER_ATTEMPT: u32 = 60;
/// Poor steps after which the search begins again from another start.
const MAX_POOR_STEPS: u32 = 4;
/// A step is poor when it leaves more than this fraction of the squared error.
const POOR_STEP_RATIO: f64 = 0.7;
/// Fraction of the required precision at which the search ends: a last step costs little and gains several digits.
const PRECISION_RATIO: f64 = 0.1;
/// Largest step of a joint, radians or metres.
const MAX_STEP: f64 = 1.2;

/// Where a search begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// The present posture, then random ones.
    Present,
    /// A random posture.
    Random,
}

impl Environment {
    /// Moves the joints of a group to a posture within its precisions; false, with the joints where they were, when there is none after
    /// `iterations`, which are counted down. Weights, step sizes, damping and flags of the group do not count.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn find_posture(
        &mut self,
        group: GroupId,
        start: Start,
        iterations: &mut u32,
    ) -> Result<bool> {
        let chains = self.take_chains(group)?;
        let mut search = Search {
            group,
            chains,
            equations: std::mem::take(&mut self.group_mut(group)?.equations),
            step: Vec::new(),
            scratch: Scratch::default(),
        };
        let found = search.run(self, start, iterations);
        let state = self.group_mut(group)?;
        (state.chains, state.equations) = (Some(search.chains), search.equations);
        found
    }

    /// The sum over the elements of a group of the metric distances between tip and target: factors of x, y, z (m) and the angle (rad).
    ///
    /// # Errors
    /// When there is no such group.
    pub fn distance(&mut self, group: GroupId, metric: [f64; 4]) -> Result<f64> {
        let mut sum = 0.0;
        for (_, element) in self.group(group)?.elements() {
            let Some(target) = self.partner(element.tip)? else {
                continue;
            };
            let [tip, target] = [element.tip, target].map(|id| self.pose(id, crate::Frame::World));
            let (tip, target) = (tip?, target?);
            let gap = target.translation.vector - tip.translation.vector;
            let angle = tip.rotation.angle_to(&target.rotation);
            let parts = [gap.x, gap.y, gap.z, angle];
            sum += parts
                .iter()
                .zip(metric)
                .map(|(part, factor)| (part * factor) * (part * factor))
                .sum::<f64>()
                .sqrt();
        }
        Ok(sum)
    }

    /// Moves all joints of a group to random places within their limits.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn move_randomly(&mut self, group: GroupId) -> Result<()> {
        let chains = self.take_chains(group)?;
        self.draw(&chains.columns);
        self.group_mut(group)?.chains = Some(chains);
        Ok(())
    }

    fn draw(&mut self, columns: &[JacobianColumn]) {
        for column in columns.iter().filter(|column| column.stage == 0) {
            if let Some(joint) = self.objects[column.joint.0]
                .as_mut()
                .and_then(Object::joint_mut)
            {
                joint.move_randomly(&mut self.random);
            }
            self.move_dependent(column.joint);
        }
    }
}

impl Joint {
    fn move_randomly(&mut self, random: &mut Random) {
        if self.joint_type == JointType::Spherical {
            self.rotation = rotation(random);
            return;
        }
        let share = random.uniform();
        let drawn = match self.limits() {
            Some([low, high]) => low + share * (high - low),
            None => PI * (2.0 * share - 1.0),
        };
        if drawn.is_finite() {
            self.position = self.within_limits(drawn);
        }
    }
}

/// All rotations are equally likely (K. Shoemake, *Uniform random rotations*, Graphics Gems III, 1992).
fn rotation(random: &mut Random) -> UnitQuaternion<f64> {
    let (share, first, second) = (
        random.uniform(),
        TAU * random.uniform(),
        TAU * random.uniform(),
    );
    let (a, b) = ((1.0 - share).sqrt(), share.sqrt());
    let ((s1, c1), (s2, c2)) = (libm::sincos(first), libm::sincos(second));
    UnitQuaternion::new_normalize(Quaternion::new(b * c2, a * s1, a * c1, b * s2))
}

struct Search {
    group: GroupId,
    chains: Chains,
    equations: Equations,
    step: Vec<f64>,
    scratch: Scratch,
}

impl Search {
    fn run(&mut self, env: &mut Environment, start: Start, iterations: &mut u32) -> Result<bool> {
        if !self.chains.valid {
            return Ok(false);
        }
        let before = self.chains.columns.iter().map(|column| {
            env.joint(column.joint)
                .map(|joint| (column.joint, joint.position, joint.rotation))
        });
        let before: Vec<_> = before.collect::<Result<_>>()?;
        self.equations.restart(PRECISION_RATIO);
        let mut draw = start == Start::Random;
        while *iterations > 0 {
            if draw {
                env.draw(&self.chains.columns);
            }
            draw = true;
            if self.attempt(env, iterations)? {
                return Ok(true);
            }
        }
        env.restore(&before);
        Ok(false)
    }

    fn attempt(&mut self, env: &mut Environment, iterations: &mut u32) -> Result<bool> {
        let mut error = self.evaluate(env)?;
        let mut poor = 0;
        // The evaluation of the start counts as well: an attempt may end at once.
        *iterations -= 1;
        for _ in 0..ITERATIONS_PER_ATTEMPT.min(*iterations) {
            if self.equations.is_within() {
                return Ok(true);
            }
            let problem = Problem {
                jacobian: &self.equations.jacobian,
                columns: self.chains.columns.len(),
                damping: (DAMPING_GAIN * error + MIN_DAMPING).sqrt(),
            };
            if !problem.solve(&self.equations.errors, &mut self.step, &mut self.scratch) {
                return Ok(false);
            }
            self.apply(env)?;
            *iterations -= 1;
            let next = self.evaluate(env)?;
            poor += u32::from(exceeds(next, POOR_STEP_RATIO * error));
            if poor > MAX_POOR_STEPS {
                return Ok(self.equations.is_within());
            }
            error = next;
        }
        Ok(self.equations.is_within())
    }

    /// Returns the squared error.
    fn evaluate(&mut self, env: &Environment) -> Result<f64> {
        self.equations.evaluate(
            env,
            env.group(self.group)?,
            &self.chains,
            Angles::RotationVector,
        )?;
        Ok(self.equations.errors.iter().map(|e| e * e).sum())
    }

    /// Moves the joints within their limits.
    fn apply(&mut self, env: &mut Environment) -> Result<()> {
        let longest = self.step.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let scale = if longest > MAX_STEP {
            MAX_STEP / longest
        } else {
            1.0
        };
        let mut at = 0;
        while at < self.step.len() {
            let id = self.chains.columns[at].joint;
            let Some(joint) = env.objects[id.0].as_mut().and_then(Object::joint_mut) else {
                return Ok(());
            };
            if joint.joint_type == JointType::Spherical {
                joint.turn(
                    nalgebra::Vector3::new(self.step[at], self.step[at + 1], self.step[at + 2])
                        * scale,
                );
                at += 3;
                continue;
            }
            joint.position = joint.within_limits(joint.position + self.step[at] * scale);
            env.move_dependent(id);
            at += 1;
        }
        Ok(())
    }
}
