//! The groups of inverse kinematics of V-REP. Files from before 4.2 contain them, and scripts create them; the crate `ik` solves them.

use std::collections::{BTreeMap, BTreeSet};

use crate::{Handle, Scene};

const FIRST_HANDLE: i64 = 2_030_003;

/// A group of inverse kinematics with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct IkGroup {
    /// Unique among the groups.
    pub name: String,
    /// Stays with it when the scene is saved.
    pub persistent_uid: String,
    /// Left out when all are handled.
    pub explicit: bool,
    /// Resolution method, bits, and what it is performed after, as in the file.
    pub method: i32,
    /// Bits of the file whose meaning does not matter here.
    pub flags: u8,
    /// The group that is solved before it, as in the file; -1 for none.
    pub performed_after: i32,
    /// At most so many iterations for each call.
    pub max_iterations: i32,
    /// Damping of the damped least squares method.
    pub damping: f64,
    /// What only scripts decide; files do not say.
    pub options: IkGroupOptions,
    /// The tips that follow their targets.
    pub elements: Vec<IkElement>,
    /// Of the last calculation.
    pub jacobian: Option<Jacobian>,
}

/// How a group is handled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct IkGroupOptions {
    /// It is solved.
    pub enabled: bool,
    /// Joints may move further in one iteration than their maximum.
    pub ignores_max_steps: bool,
    /// Joints return to where they were when the linear precision is missed.
    pub restores_on_bad_linear: bool,
    /// The same for the angular precision.
    pub restores_on_bad_angular: bool,
}

impl Default for IkGroupOptions {
    fn default() -> Self {
        Self {
            enabled: true,
            ignores_max_steps: true,
            restores_on_bad_linear: false,
            restores_on_bad_angular: false,
        }
    }
}

/// How the errors of a group change with its joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Jacobian {
    /// One for each joint of the group.
    pub columns: usize,
    /// One for each constrained coordinate of the elements.
    pub rows: usize,
    /// Row by row; metres and radians per metre and radian.
    pub values: Vec<f64>,
}

impl IkGroup {
    /// Without elements, as V-REP makes one.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.into(),
            persistent_uid: String::new(),
            explicit: false,
            method: 0,
            flags: 0,
            performed_after: -1,
            max_iterations: 3,
            damping: 0.1,
            options: IkGroupOptions::default(),
            elements: Vec::new(),
            jacobian: None,
        }
    }
}

/// A tip that follows its target.
#[derive(Debug, Clone, PartialEq)]
pub struct IkElement {
    /// The dummy that follows the one it is linked with.
    pub tip: Handle,
    /// Where the chain of joints begins; None for the world.
    pub base: Option<Handle>,
    /// The frame of the constraints; None for that of the base.
    pub constraint_base: Option<Handle>,
    /// Radians, metres.
    pub precisions: [f64; 2],
    /// Of position and orientation.
    pub weights: [f64; 2],
    /// `sim.ik_*_constraint`: the coordinates that follow.
    pub constraints: i32,
    /// Bits of the file whose meaning does not matter here.
    pub flags: u8,
    /// What only scripts decide; files do not say.
    pub enabled: bool,
}

impl IkElement {
    /// A tip whose position follows, in the frame of the world.
    pub fn new(tip: Handle) -> Self {
        Self {
            tip,
            base: None,
            constraint_base: None,
            precisions: [0.1_f64.to_radians(), 0.0005],
            weights: [1.0; 2],
            constraints: 7,
            flags: 0,
            enabled: true,
        }
    }
}

/// All groups, by handles that are not used again.
#[derive(Debug, Clone, Default)]
pub struct IkGroups {
    by_handle: BTreeMap<i64, IkGroup>,
    made: i64,
}

impl IkGroups {
    /// Adds one; where its name is taken it gets a number.
    pub fn add(&mut self, mut group: IkGroup) -> i64 {
        group.name = super::old_names::free_name(group.name, |name| self.named(name).is_some());
        let handle = FIRST_HANDLE + self.made;
        self.made += 1;
        self.by_handle.insert(handle, group);
        handle
    }

    /// The handle of the one with that name.
    pub fn named(&self, name: &str) -> Option<i64> {
        self.by_handle
            .iter()
            .find(|(_, group)| group.name == name)
            .map(|(handle, _)| *handle)
    }

    /// The group with that handle.
    pub fn get(&self, handle: i64) -> Option<&IkGroup> {
        self.by_handle.get(&handle)
    }

    /// The group with that handle, to be changed.
    pub fn get_mut(&mut self, handle: i64) -> Option<&mut IkGroup> {
        self.by_handle.get_mut(&handle)
    }

    /// Removes a group and returns it.
    pub fn remove(&mut self, handle: i64) -> Option<IkGroup> {
        self.by_handle.remove(&handle)
    }

    /// Removes all groups.
    pub fn clear(&mut self) {
        self.by_handle.clear();
    }

    /// With their handles, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (i64, &IkGroup)> {
        self.by_handle
            .iter()
            .map(|(handle, group)| (*handle, group))
    }

    /// Removes elements whose tip is removed, and groups that are left without one.
    pub(super) fn forget(&mut self, removed: &BTreeSet<Handle>) {
        self.by_handle.retain(|_, group| {
            let before = group.elements.len();
            group
                .elements
                .retain(|element| !removed.contains(&element.tip));
            for element in &mut group.elements {
                element.base = element.base.filter(|base| !removed.contains(base));
                element.constraint_base = element
                    .constraint_base
                    .filter(|base| !removed.contains(base));
            }
            before == 0 || !group.elements.is_empty()
        });
    }
}

impl Scene {
    /// The groups of inverse kinematics of the scene.
    pub fn ik_groups(&self) -> &IkGroups {
        &self.ik_groups
    }

    /// The groups of inverse kinematics of the scene, to be changed.
    pub fn ik_groups_mut(&mut self) -> &mut IkGroups {
        &mut self.ik_groups
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_group_ends_with_its_last_tip() {
        let element = |tip| IkElement {
            base: Some(Handle(9)),
            ..IkElement::new(Handle(tip))
        };
        let group = |elements| IkGroup {
            elements,
            ..IkGroup::new("ik")
        };
        let mut groups = IkGroups::default();
        let handles = [group(vec![element(1)]), group(vec![element(1), element(2)])]
            .map(|group| groups.add(group));
        assert_eq!(handles, [2_030_003, 2_030_004]);
        assert_eq!(
            (groups.named("ik"), groups.named("ik0")),
            (Some(2_030_003), Some(2_030_004))
        );
        groups.forget(&BTreeSet::from([Handle(1), Handle(9)]));
        assert!(groups.get(2_030_003).is_none());
        let left = groups.get(2_030_004).expect("it has another tip");
        assert_eq!((left.elements.len(), left.elements[0].base), (1, None));
    }
}
