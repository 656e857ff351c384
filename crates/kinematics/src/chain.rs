//! The elements of a group, compiled: joints from base to tip with fixed transforms between them.

use crate::environment::{Environment, Frame};
use crate::equations::JacobianColumn;
use crate::error::Result;
use crate::group::{Constraints, ElementId, GroupId};
use crate::joint::{JointMode, JointType};
use crate::object::ObjectId;
use crate::rigid::Rigid;

/// All enabled elements of a group, and the joints that move them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Chains {
    /// The environment's count of changes when this was compiled.
    structure: u64,
    pub columns: Vec<JacobianColumn>,
    pub chains: Vec<Chain>,
    /// False where an element has no target or no joint, or there are no elements.
    pub valid: bool,
}

#[derive(Debug, Clone)]
pub(crate) struct Chain {
    pub element: ElementId,
    pub constraints: Constraints,
    pub target: ObjectId,
    pub base: Option<ObjectId>,
    pub constraint_base: Option<ObjectId>,
    pub links: Vec<Link>,
    /// From the moving side of the last joint to the tip.
    pub to_tip: Rigid,
    /// Whether joints are above the target or a base, so that these may move with the chains.
    pub moving_frames: bool,
}

#[derive(Debug, Clone)]
pub(crate) struct Link {
    /// From the moving side of the joint before, or the base, to the joint.
    pub before: Rigid,
    pub joint: ObjectId,
    /// The first column of its root master; none where the solver does not move it.
    pub column: Option<usize>,
    pub dependent: bool,
}

impl Environment {
    /// The chains of a group: those that were compiled last, if nothing has changed since.
    pub(crate) fn take_chains(&mut self, group: GroupId) -> Result<Chains> {
        let structure = self.structure;
        match self.group_mut(group)?.chains.take() {
            Some(chains) if chains.structure == structure => Ok(chains),
            _ => self.compile(group),
        }
    }

    fn compile(&self, group: GroupId) -> Result<Chains> {
        let mut chains = Chains {
            structure: self.structure,
            ..Chains::default()
        };
        chains.valid = true;
        let enabled = self
            .group(group)?
            .elements()
            .filter(|(_, element)| element.enabled);
        for id in enabled.map(|(id, _)| id) {
            match self.compile_element(group, id, &mut chains.columns)? {
                Some(chain) => chains.chains.push(chain),
                None => chains.valid = false,
            }
        }
        chains.valid &= !chains.chains.is_empty();
        Ok(chains)
    }

    fn compile_element(
        &self,
        group: GroupId,
        id: ElementId,
        columns: &mut Vec<JacobianColumn>,
    ) -> Result<Option<Chain>> {
        let element = self.element(group, id)?;
        let Some(target) = self.partner(element.tip)? else {
            return Ok(None);
        };
        let path = self.path_to(element.tip, element.base)?;
        let mut links = Vec::new();
        let mut before = Rigid::identity();
        for object in path {
            before = before.after(&Rigid::from(&self.pose(object, Frame::Parent)?));
            if self.object(object)?.joint().is_some() {
                links.push(self.compile_link(object, before, columns)?);
                before = Rigid::identity();
            }
        }
        if links.iter().all(|link| link.column.is_none()) {
            return Ok(None);
        }
        let frames = [Some(target), element.base, element.constraint_base];
        let mut moving_frames = false;
        for frame in frames.into_iter().flatten() {
            moving_frames |= self.is_below_joint(frame)?;
        }
        Ok(Some(Chain {
            element: id,
            constraints: element.constraints,
            target,
            base: element.base,
            constraint_base: element.constraint_base.or(element.base),
            links,
            to_tip: before,
            moving_frames,
        }))
    }

    /// Objects from below the base (or the world) to the tip.
    fn path_to(&self, tip: ObjectId, base: Option<ObjectId>) -> Result<Vec<ObjectId>> {
        let mut path = vec![tip];
        let mut next = self.object(tip)?.parent();
        while let Some(object) = next.filter(|object| Some(*object) != base) {
            path.push(object);
            next = self.object(object)?.parent();
        }
        path.reverse();
        Ok(path)
    }

    fn compile_link(
        &self,
        joint: ObjectId,
        before: Rigid,
        columns: &mut Vec<JacobianColumn>,
    ) -> Result<Link> {
        let root = self.root_master(joint)?;
        let master = self.joint(root)?;
        let moved = master.mode == JointMode::Ik;
        let stages = if master.joint_type == JointType::Spherical {
            3
        } else {
            1
        };
        let column = moved.then(|| {
            columns
                .iter()
                .position(|column| column.joint == root)
                .unwrap_or_else(|| {
                    columns.extend((0..stages).map(|stage| JacobianColumn { joint: root, stage }));
                    columns.len() - stages
                })
        });
        Ok(Link {
            before,
            joint,
            column,
            dependent: root != joint,
        })
    }

    fn is_below_joint(&self, id: ObjectId) -> Result<bool> {
        let mut next = self.object(id)?.parent();
        while let Some(object) = next {
            if self.object(object)?.joint().is_some() {
                return Ok(true);
            }
            next = self.object(object)?.parent();
        }
        Ok(false)
    }

    /// The frame in which a chain begins: the moving side of its base.
    pub(crate) fn start_of(&self, base: Option<ObjectId>) -> Result<Rigid> {
        base.map_or(Ok(Rigid::identity()), |base| {
            self.moving_side(base).map(|pose| Rigid::from(&pose))
        })
    }
}
