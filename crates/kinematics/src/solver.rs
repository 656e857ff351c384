//! Iterations of one or several groups: steps of the joints that bring tips to their targets.

use nalgebra::{DMatrix, DVector, UnitQuaternion};

use crate::chain::Chains;
use crate::environment::Environment;
use crate::equations::{Angles, Equations, JacobianColumn};
use crate::error::{KinematicsError, Result};
use crate::group::{Flags, GroupFlags, GroupId, LimitHit};
use crate::joint::JointType;
use crate::least_squares::Scratch;
use crate::object::{Object, ObjectId};
use crate::step::{Solved, Step, too_big, weigh};

/// Steps that are too big are reduced to the largest allowed one divided by this.
const STEP_REDUCTION_MARGIN: f64 = 1.1;

/// The result of a calculation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// What went wrong.
    pub flags: Flags,
    /// Largest linear (m) and angular (rad) error.
    pub precision: [f64; 2],
}

impl Outcome {
    /// Whether it was done, with all errors within the precisions.
    pub fn is_success(&self) -> bool {
        !self.flags.intersects(Flags(
            Flags::NOT_PERFORMED.0 | Flags::CANNOT_INVERT.0 | Flags::NOT_WITHIN_TOLERANCE.0,
        ))
    }
}

/// What a callback puts in place of what was computed; row by row where it is a matrix.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Revision {
    /// Of the group, rows by columns.
    pub jacobian: Option<Vec<f64>>,
    /// A number per row.
    pub errors: Option<Vec<f64>>,
    /// Changes of the joints, a number per column.
    pub step: Option<Vec<f64>>,
    /// The pseudo-inverse: columns by rows.
    pub inverse: Option<Vec<f64>>,
}

/// Revises the equations of a group: its index and the iteration come with them, both from 0.
pub type Revise<'a> = dyn FnMut(&Equations, usize, u32) -> Result<Revision> + 'a;

impl Environment {
    /// Moves the joints of groups towards a solution. The first group has the highest priority, and its number of iterations counts.
    ///
    /// # Errors
    /// When there is no such group.
    pub fn handle(&mut self, groups: &[GroupId]) -> Result<Outcome> {
        self.handle_with(groups, &mut |_, _, _| Ok(Revision::default()))
    }

    /// The same with a callback that may revise each iteration of each group.
    ///
    /// # Errors
    /// When there is no such group, the callback fails, or a matrix of it has the wrong size.
    pub fn handle_with(&mut self, groups: &[GroupId], revise: &mut Revise<'_>) -> Result<Outcome> {
        let mut calculation = Calculation::begin(self, groups)?;
        let outcome = calculation.run(self, revise);
        calculation.end(self);
        outcome
    }
}

/// A group while it is handled.
struct Task {
    group: GroupId,
    chains: Chains,
    equations: Equations,
    /// Its columns among those of all groups.
    places: Vec<usize>,
    flags: GroupFlags,
}

/// Groups that are handled together.
struct Calculation {
    tasks: Vec<Task>,
    /// Of all groups.
    columns: Vec<JacobianColumn>,
    iterations: u32,
    before: Vec<(ObjectId, f64, UnitQuaternion<f64>)>,
    flags: Flags,
    limit_hits: Vec<LimitHit>,
    scratch: Scratch,
}

impl Calculation {
    fn begin(env: &mut Environment, groups: &[GroupId]) -> Result<Self> {
        let mut columns: Vec<JacobianColumn> = Vec::new();
        let mut tasks = Vec::new();
        groups
            .iter()
            .try_for_each(|group| env.group(*group).map(drop))?;
        for &group in groups {
            let chains = env.take_chains(group)?;
            let places = chains.columns.iter().map(|column| {
                columns
                    .iter()
                    .position(|other| other == column)
                    .unwrap_or_else(|| {
                        columns.push(*column);
                        columns.len() - 1
                    })
            });
            let places = places.collect();
            let state = env.group_mut(group)?;
            let (mut equations, flags) = (std::mem::take(&mut state.equations), state.flags);
            equations.restart(1.0);
            tasks.push(Task {
                group,
                chains,
                equations,
                places,
                flags,
            });
        }
        let iterations = groups.first().map_or(Ok(0), |group| {
            env.group(*group).map(|group| group.iterations.max(1))
        })?;
        let before = columns.iter().map(|column| {
            env.joint(column.joint)
                .map(|joint| (column.joint, joint.position, joint.rotation))
        });
        let before = before.collect::<Result<_>>()?;
        let (flags, limit_hits, scratch) = (Flags::default(), Vec::new(), Scratch::default());
        Ok(Self {
            tasks,
            columns,
            iterations,
            before,
            flags,
            limit_hits,
            scratch,
        })
    }

    /// Returns what was taken out of the groups.
    fn end(self, env: &mut Environment) {
        for task in self.tasks {
            if let Ok(group) = env.group_mut(task.group) {
                group.chains = Some(task.chains);
                group.equations = task.equations;
                group.limit_hits.clone_from(&self.limit_hits);
            }
        }
    }

    fn run(&mut self, env: &mut Environment, revise: &mut Revise<'_>) -> Result<Outcome> {
        let is_ready = |task: &Task| task.chains.valid && task.flags.contains(GroupFlags::ENABLED);
        if self.tasks.is_empty() || !self.tasks.iter().all(is_ready) {
            return Ok(Outcome {
                flags: Flags::NOT_PERFORMED,
                precision: [0.0; 2],
            });
        }
        self.evaluate(env)?;
        for iteration in 0..self.iterations {
            let Some(step) = self.step(env, iteration, revise)? else {
                self.flags.insert(Flags::CANNOT_INVERT);
                break;
            };
            let hit = self.apply(env, &step)?;
            self.evaluate(env)?;
            let stop = hit
                && self
                    .tasks
                    .iter()
                    .any(|task| task.flags.contains(GroupFlags::STOP_ON_LIMIT_HIT));
            if stop || self.tasks.iter().all(|task| task.equations.is_within()) {
                break;
            }
        }
        let precision = self.precision();
        self.conclude(env)?;
        Ok(Outcome {
            flags: self.flags,
            precision,
        })
    }

    fn evaluate(&mut self, env: &Environment) -> Result<()> {
        for Task {
            group,
            chains,
            equations,
            ..
        } in &mut self.tasks
        {
            equations.evaluate(env, env.group(*group)?, chains, Angles::Euler)?;
        }
        Ok(())
    }

    fn precision(&self) -> [f64; 2] {
        let largest = |i: usize| {
            self.tasks
                .iter()
                .map(|task| task.equations.precision[i])
                .fold(0.0, f64::max)
        };
        [largest(0), largest(1)]
    }

    /// `dq1 + (I - J1+ J1) (dq2 + ...)` for all columns; None where it cannot be computed.
    fn step(
        &mut self,
        env: &Environment,
        iteration: u32,
        revise: &mut Revise<'_>,
    ) -> Result<Option<Vec<f64>>> {
        let alone = self.tasks.len() == 1;
        let width = self.columns.len();
        let mut total = vec![0.0; width];
        let mut free: Option<DMatrix<f64>> = None;
        for index in 0..self.tasks.len() {
            let Some(solved) = self.solve(env, index, iteration, revise, !alone)? else {
                return Ok(None);
            };
            let places = &self.tasks[index].places;
            let mut step = DVector::zeros(width);
            places
                .iter()
                .zip(&solved.step)
                .for_each(|(place, dq)| step[*place] = *dq);
            let step = free
                .as_ref()
                .map_or_else(|| step.clone(), |free| free * &step);
            total
                .iter_mut()
                .zip(step.iter())
                .for_each(|(sum, dq)| *sum += dq);
            if let Some(used) = solved.used {
                let mut remaining = DMatrix::identity(width, width);
                for (i, a) in places.iter().enumerate() {
                    places
                        .iter()
                        .enumerate()
                        .for_each(|(j, b)| remaining[(*a, *b)] -= used[(i, j)]);
                }
                free = Some(match free {
                    Some(free) => free * remaining,
                    None => remaining,
                });
            }
        }
        Ok(total.iter().all(|dq| dq.is_finite()).then_some(total))
    }

    /// The step of one group, and `J+ J` where others come after it.
    fn solve(
        &mut self,
        env: &Environment,
        index: usize,
        iteration: u32,
        revise: &mut Revise<'_>,
        with_used: bool,
    ) -> Result<Option<Solved>> {
        let task = &mut self.tasks[index];
        let group = env.group(task.group)?;
        let revision = revise(&task.equations, index, iteration)?;
        revision.check(&task.equations)?;
        if !revision.is_finite() {
            self.flags.insert(Flags::INVALID_CALLBACK_DATA);
            return Ok(None);
        }
        let jacobian = revision
            .jacobian
            .as_ref()
            .unwrap_or(&task.equations.jacobian);
        let mut errors = revision
            .errors
            .as_ref()
            .unwrap_or(&task.equations.errors)
            .clone();
        weigh(group, &task.equations.rows, &mut errors);
        let step = Step {
            group,
            jacobian,
            columns: &task.equations.columns,
            revision: &revision,
        };
        let Some(mut solved) = step.solve(env, &errors, with_used, &mut self.scratch)? else {
            return Ok(None);
        };
        let ratio = too_big(env, &task.equations.columns, &solved.step)?;
        if ratio > 1.0 {
            self.flags.insert(Flags::STEPS_TOO_BIG);
            if !task.flags.contains(GroupFlags::IGNORE_MAX_STEPS) {
                solved
                    .step
                    .iter_mut()
                    .for_each(|dq| *dq /= STEP_REDUCTION_MARGIN * ratio);
            }
        }
        Ok(Some(solved))
    }

    /// Moves the joints; whether one of them was stopped at a limit.
    fn apply(&mut self, env: &mut Environment, step: &[f64]) -> Result<bool> {
        self.limit_hits.clear();
        let mut at = 0;
        while at < self.columns.len() {
            let id = self.columns[at].joint;
            let joint = env.objects[id.0].as_mut().and_then(Object::joint_mut);
            let joint = joint.ok_or(KinematicsError::NoSuchObject)?;
            if joint.joint_type == JointType::Spherical {
                joint.turn(nalgebra::Vector3::new(step[at], step[at + 1], step[at + 2]));
                at += 3;
                continue;
            }
            let wanted = joint.position + step[at];
            joint.position = joint.within_limits(wanted);
            let overshoot = wanted - joint.position;
            if joint.limits().is_some() && overshoot != 0.0 {
                self.limit_hits.push(LimitHit {
                    joint: id,
                    overshoot,
                });
            }
            env.move_dependent(id);
            at += 1;
        }
        let hit = !self.limit_hits.is_empty();
        if hit {
            self.flags.insert(Flags::LIMIT_HIT);
        }
        Ok(hit)
    }

    /// Flags what was missed, and puts the joints back where a group asks for it.
    fn conclude(&mut self, env: &mut Environment) -> Result<()> {
        let missed = |flag: GroupFlags, linear: bool| {
            self.tasks.iter().any(|task| {
                let missed = if linear {
                    task.equations.linear_missed
                } else {
                    task.equations.angular_missed
                };
                task.flags.contains(flag) && missed
            })
        };
        let restore = missed(GroupFlags::RESTORE_ON_BAD_LINEAR, true)
            || missed(GroupFlags::RESTORE_ON_BAD_ANGULAR, false);
        if !self.tasks.iter().all(|task| task.equations.is_within()) {
            self.flags.insert(Flags::NOT_WITHIN_TOLERANCE);
        }
        if restore || self.flags.contains(Flags::CANNOT_INVERT) {
            env.restore(&self.before);
        }
        Ok(())
    }
}

impl Environment {
    pub(crate) fn restore(&mut self, before: &[(ObjectId, f64, UnitQuaternion<f64>)]) {
        for (id, position, rotation) in before {
            if let Some(joint) = self.objects[id.0].as_mut().and_then(Object::joint_mut) {
                (joint.position, joint.rotation) = (*position, *rotation);
            }
            self.move_dependent(*id);
        }
    }
}

impl Revision {
    fn check(&self, equations: &Equations) -> Result<()> {
        let (rows, columns) = (equations.rows.len(), equations.columns.len());
        let sizes = [
            ("jacobian", &self.jacobian, rows * columns),
            ("e", &self.errors, rows),
            ("dq", &self.step, columns),
            ("jacobianPinv", &self.inverse, rows * columns),
        ];
        for (name, values, size) in sizes {
            if values.as_ref().is_some_and(|values| values.len() != size) {
                return Err(KinematicsError::Callback(format!(
                    "the callback's '{name}' has a wrong size."
                )));
            }
        }
        Ok(())
    }

    fn is_finite(&self) -> bool {
        let values = [&self.jacobian, &self.errors, &self.step, &self.inverse];
        values
            .into_iter()
            .flatten()
            .flatten()
            .all(|x| x.is_finite())
    }
}
