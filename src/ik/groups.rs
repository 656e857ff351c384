//! The groups of inverse kinematics of old scenes: copied from the scene, solved, and written back (spec: kinematics 7).

use kinematics::{Constraints, Environment, Flags, GroupId, JointMode, Method, Outcome};

use super::{SceneElement, SceneLinks};
use crate::scene::tree::ik_groups::IkGroup;
use crate::scene::{Handle, Scene, SceneResult, joint};

/// More iterations would not end in a reasonable time.
const MOST_ITERATIONS: i32 = 100_000;

/// A group that was solved on a copy.
pub(crate) struct SolvedGroup {
    env: Environment,
    links: SceneLinks,
    group: GroupId,
    outcome: Outcome,
}

impl SolvedGroup {
    /// Solves a group. Only joints in the old mode of inverse kinematics move. An element whose tip has no linked dummy makes the group
    /// not performed.
    ///
    /// # Errors
    /// When an object is gone, or tip or target is a joint.
    pub(crate) fn new(scene: &Scene, group: &IkGroup) -> SceneResult<Self> {
        let (mut env, mut links) = (Environment::new(0), SceneLinks::default());
        let id = env.create_group(&group.name);
        let copy = env.group_mut(id)?;
        copy.method = Method::from_raw(group.method.into()).unwrap_or(Method::PseudoInverse);
        copy.damping = group.damping;
        copy.iterations = group.max_iterations.clamp(1, MOST_ITERATIONS) as u32;
        for element in &group.elements {
            let Some(target) = scene.object(element.tip)?.dummy()?.link else {
                let outcome = Outcome { flags: Flags::NOT_PERFORMED, precision: [0.0; 2] };
                return Ok(Self { env, links, group: id, outcome });
            };
            let constraints = Constraints(element.constraints as u32 & Constraints::POSE.0);
            let added = SceneElement { base: element.base, tip: element.tip, target, constraints };
            let added = links.add_element(scene, &mut env, id, &added)?;
            let frame = element.constraint_base.map(|frame| links.copy(scene, &mut env, frame)).transpose()?;
            let [angular, linear] = element.precisions;
            let copy = env.element_mut(id, added)?;
            (copy.precision, copy.constraint_base) = ([linear, angular], frame);
            copy.weights = [element.weights[0], element.weights[1], 1.0];
        }
        links.keep_other_joints(scene, &mut env)?;
        let outcome = env.handle(&[id])?;
        Ok(Self { env, links, group: id, outcome })
    }

    /// 0 not performed, 1 success, 2 failure.
    pub(crate) fn result(&self) -> i64 {
        match self.outcome {
            Outcome { flags, .. } if flags.contains(Flags::NOT_PERFORMED) => 0,
            outcome if outcome.is_success() => 1,
            _ => 2,
        }
    }

    /// Moves the joints of the scene.
    ///
    /// # Errors
    /// When a joint has no place to go to.
    pub(crate) fn apply(&self, scene: &mut Scene, is_dynamic: impl Fn(Handle) -> bool) -> SceneResult<()> {
        self.links.sync_to(scene, &self.env, &[self.group], is_dynamic)
    }
}

impl SceneLinks {
    /// Makes the copies of joints passive that are not in the old mode of inverse kinematics.
    fn keep_other_joints(&self, scene: &Scene, env: &mut Environment) -> SceneResult<()> {
        for &(handle, id) in &self.joints {
            let mode = scene.object(handle)?.joint()?.mode;
            if !matches!(mode, joint::JointMode::InverseKinematics | joint::JointMode::Dependent) {
                env.joint_mut(id)?.mode = JointMode::Passive;
            }
        }
        Ok(())
    }
}
