//! The groups of inverse kinematics of V-REP: copied from the scene, solved, and written back (spec: kinematics 7).

use kinematics::{
    Constraints, Environment, Flags, Frame, GroupFlags, GroupId, JointMode, Method, Outcome, Pose,
    Start,
};

use super::Result;
use super::{SceneElement, SceneLinks};
use scene::joint::{self, Joint};
use scene::tree::ik_groups::{IkElement, IkGroup, Jacobian};
use scene::{Handle, Scene, SceneError};

/// Largest number of iterations: more would not end in a reasonable time.
const MAX_ITERATIONS: i32 = 100_000;

/// What a calculation came to; scripts see the numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IkResult {
    /// No group was handled.
    NotPerformed = 0,
    /// All errors are within the precisions.
    Success = 1,
    /// An error exceeds a precision, or the equations cannot be solved.
    Failure = 2,
}

/// A script's number of a method, if there is one.
pub fn method(raw: i64) -> Option<i32> {
    Method::from_raw(raw).map(|method| method as i32)
}

/// The constraints among the bits of a script's number.
pub fn constraints(raw: i64) -> i32 {
    (raw & i64::from(Constraints::POSE.0)) as i32
}

/// A copy of a group with its chains, which is solved without moving the scene.
#[derive(Clone)]
pub struct GroupCopy {
    env: Environment,
    links: SceneLinks,
    group: GroupId,
    /// Whether all tips have linked dummies as their targets.
    complete: bool,
}

impl GroupCopy {
    /// Only joints in the old mode of inverse kinematics move. `seed` is for the random starts of [`GroupCopy::find`].
    ///
    /// # Errors
    /// When an object is gone, or tip or target is a joint.
    pub fn new(scene: &Scene, group: &IkGroup, seed: u64) -> Result<Self> {
        Self::with_joints(scene, group, seed, |_, joint| is_in_ik_mode(joint))
    }

    /// The given joints move, in whatever mode they are in the scene, and no others but those that depend on joints.
    ///
    /// # Errors
    /// When an object is gone, or tip or target is a joint.
    pub fn moving(scene: &Scene, group: &IkGroup, seed: u64, joints: &[Handle]) -> Result<Self> {
        Self::with_joints(scene, group, seed, |handle, _| joints.contains(&handle))
    }

    fn with_joints(
        scene: &Scene,
        group: &IkGroup,
        seed: u64,
        moves: impl Fn(Handle, &Joint) -> bool,
    ) -> Result<Self> {
        let (mut env, mut links) = (Environment::new(seed), SceneLinks::default());
        let (id, complete) = links.add_group(scene, &mut env, group)?;
        links.keep_other_joints(scene, &mut env, moves)?;
        Ok(Self {
            env,
            links,
            group: id,
            complete,
        })
    }

    /// Whether all tips have targets.
    pub fn is_complete(&self) -> bool {
        self.complete
    }

    /// Solves the copy; the scene stays as it is.
    ///
    /// # Errors
    /// When the environment lost an object.
    pub fn solve(&mut self) -> Result<IkResult> {
        if !self.complete {
            return Ok(IkResult::NotPerformed);
        }
        Ok(match self.env.handle(&[self.group])? {
            Outcome { flags, .. } if flags.contains(Flags::NOT_PERFORMED) => IkResult::NotPerformed,
            outcome if outcome.is_success() => IkResult::Success,
            _ => IkResult::Failure,
        })
    }

    /// Searches any posture within the precisions, from random ones; false if there was none after `iterations`, which are counted down.
    ///
    /// # Errors
    /// When the environment lost an object.
    pub fn find(&mut self, iterations: &mut u32) -> Result<bool> {
        if !self.complete {
            *iterations = 0;
            return Ok(false);
        }
        Ok(self
            .env
            .find_posture(self.group, Start::Random, iterations)?)
    }

    /// Limits the search to a part of a joint's interval. Joints outside of the group have no part in it.
    ///
    /// # Errors
    /// When the object is no joint.
    pub fn limit(&mut self, joint: Handle, min: f64, range: f64) -> Result<()> {
        let Some(&id) = self.links.copies.get(&joint) else {
            return Ok(());
        };
        let copy = self.env.joint_mut(id)?;
        (copy.cyclic, copy.min, copy.range) = (false, min, range);
        let position = copy.position;
        if copy.joint_type == kinematics::JointType::Spherical {
            return Ok(());
        }
        Ok(self.env.set_joint_position(id, position)?)
    }

    /// Poses of all tips with their targets, in the world.
    ///
    /// # Errors
    /// When the environment lost an object.
    pub fn ends(&self) -> Result<Vec<[Pose; 2]>> {
        let tips = self.tips()?;
        let pose = |id| self.env.pose(id, Frame::World);
        tips.into_iter()
            .map(|[tip, target]| Ok([pose(tip)?, pose(target)?]))
            .collect()
    }

    /// Moves all targets to poses in the world.
    ///
    /// # Errors
    /// When the environment lost an object, or a pose is not finite.
    pub fn set_targets(&mut self, poses: impl IntoIterator<Item = Pose>) -> Result<()> {
        for ([_, target], pose) in self.tips()?.into_iter().zip(poses) {
            self.env.set_pose(target, pose, Frame::World)?;
        }
        Ok(())
    }

    fn tips(&self) -> Result<Vec<[kinematics::ObjectId; 2]>> {
        let elements = self.env.group(self.group)?.elements();
        let pair = |tip| Ok([tip, self.env.partner(tip)?.ok_or(SceneError::NoSuchObject)?]);
        elements.map(|(_, element)| pair(element.tip)).collect()
    }

    /// Positions of joints; of those outside of the group, their positions in the scene.
    ///
    /// # Errors
    /// When one of them is no joint.
    pub fn config(&self, scene: &Scene, joints: &[Handle]) -> Result<Vec<f64>> {
        let position = |joint: &Handle| match self.links.copies.get(joint) {
            Some(&id) => Ok(self
                .env
                .joint(id)
                .map_err(|_| SceneError::WrongType("joint"))?
                .position),
            None => Ok(scene.object(*joint)?.joint()?.position),
        };
        joints.iter().map(position).collect()
    }

    /// None where the group has no element that can be calculated. With `weighted` each column is multiplied by the weight of its joint.
    ///
    /// # Errors
    /// When the environment lost an object.
    pub fn jacobian(&mut self, weighted: bool) -> Result<Option<Jacobian>> {
        if !self.complete {
            return Ok(None);
        }
        let Some(equations) = self.env.equations(self.group)? else {
            return Ok(None);
        };
        let (columns, rows) = (equations.columns.len(), equations.rows.len());
        let mut values = equations.jacobian;
        if weighted {
            let weight = |column: &kinematics::JacobianColumn| {
                self.env
                    .joint(column.joint)
                    .map(|joint| joint.weight.max(0.0))
            };
            let weights = equations
                .columns
                .iter()
                .map(weight)
                .collect::<kinematics::Result<Vec<f64>>>()?;
            values
                .iter_mut()
                .zip(weights.iter().cycle())
                .for_each(|(value, weight)| *value *= weight);
        }
        Ok(Some(Jacobian {
            columns,
            rows,
            values,
        }))
    }

    /// Moves the joints of the scene.
    ///
    /// # Errors
    /// When a joint has no place to go to.
    pub fn apply(&self, scene: &mut Scene, is_dynamic: impl Fn(Handle) -> bool) -> Result<()> {
        self.links
            .sync_to(scene, &self.env, &[self.group], is_dynamic)
    }
}

/// All groups of a scene in one environment, with the names of their objects, as `simIK.load` reads it.
///
/// # Errors
/// When an object is gone, or tip or target is a joint.
pub fn export(scene: &Scene) -> Result<Vec<u8>> {
    let (mut env, mut links) = (
        Environment::new(0),
        SceneLinks {
            named: true,
            ..SceneLinks::default()
        },
    );
    for (_, group) in scene.ik_groups().iter() {
        links.add_group(scene, &mut env, group)?;
    }
    links.keep_other_joints(scene, &mut env, |_, joint| is_in_ik_mode(joint))?;
    Ok(env.to_bytes()?)
}

impl SceneLinks {
    /// Adds a group with its elements; whether all tips have targets.
    fn add_group(
        &mut self,
        scene: &Scene,
        env: &mut Environment,
        group: &IkGroup,
    ) -> Result<(GroupId, bool)> {
        let id = env.create_group(&group.name);
        let copy = env.group_mut(id)?;
        copy.method = Method::from_raw(group.method.into()).unwrap_or(Method::PseudoInverse);
        copy.damping = group.damping;
        copy.iterations = group.max_iterations.clamp(1, MAX_ITERATIONS) as u32;
        copy.flags = flags(group);
        let mut complete = true;
        for element in &group.elements {
            let target = scene.object(element.tip)?.dummy()?.link;
            match target {
                Some(target) => self.add_element_of_group(scene, env, id, element, target)?,
                None => complete = false,
            }
        }
        Ok((id, complete))
    }

    fn add_element_of_group(
        &mut self,
        scene: &Scene,
        env: &mut Environment,
        group: GroupId,
        element: &IkElement,
        target: Handle,
    ) -> Result<()> {
        let constraints = Constraints(element.constraints as u32 & Constraints::POSE.0);
        let added = SceneElement {
            base: element.base,
            tip: element.tip,
            target,
            constraints,
        };
        let added = self.add_element(scene, env, group, &added)?;
        let frame = element
            .constraint_base
            .map(|frame| self.copy(scene, env, frame))
            .transpose()?;
        let [angular, linear] = element.precisions;
        let copy = env.element_mut(group, added)?;
        (copy.precision, copy.constraint_base, copy.enabled) =
            ([linear, angular], frame, element.enabled);
        copy.weights = [element.weights[0], element.weights[1], 1.0];
        Ok(())
    }

    /// Makes the copies of joints passive that neither move nor depend on others.
    fn keep_other_joints(
        &self,
        scene: &Scene,
        env: &mut Environment,
        moves: impl Fn(Handle, &Joint) -> bool,
    ) -> Result<()> {
        for &(handle, id) in &self.joints {
            let joint = scene.object(handle)?.joint()?;
            let copy = env.joint_mut(id)?;
            (copy.weight, copy.max_step) = (joint.ik.weight, joint.ik.max_step);
            if joint.mode != joint::JointMode::Dependent && !moves(handle, joint) {
                copy.mode = JointMode::Passive;
            }
        }
        Ok(())
    }
}

fn is_in_ik_mode(joint: &Joint) -> bool {
    joint.mode == joint::JointMode::InverseKinematics
}

fn flags(group: &IkGroup) -> GroupFlags {
    let options = group.options;
    let choices = [
        (options.enabled, GroupFlags::ENABLED),
        (options.ignores_max_steps, GroupFlags::IGNORE_MAX_STEPS),
        (
            options.restores_on_bad_linear,
            GroupFlags::RESTORE_ON_BAD_LINEAR,
        ),
        (
            options.restores_on_bad_angular,
            GroupFlags::RESTORE_ON_BAD_ANGULAR,
        ),
    ];
    let mut flags = GroupFlags::default();
    choices
        .into_iter()
        .filter(|(on, _)| *on)
        .for_each(|(_, flag)| flags.insert(flag));
    flags
}
