//! Which links of a robot never move: by its file, or because the user holds its base.

use robot_description::{JointKind, Robot};

use super::Description;

/// The links that are held themselves, and those that fixed joints hold to them; in increasing order.
pub(super) fn held_links(robot: &Robot, is_held: impl Fn(usize) -> bool) -> Vec<usize> {
    let parents = robot.parent_joints();
    let mut held = vec![false; robot.links.len()];
    for link in robot.links_from_the_roots() {
        let parent = parents[link].map(|joint| &robot.joints[joint]);
        let hangs_on_held =
            parent.is_some_and(|joint| joint.kind == JointKind::Fixed && held[joint.parent]);
        held[link] = is_held(link) || hangs_on_held;
    }
    (0..held.len()).filter(|link| held[*link]).collect()
}

impl Description {
    /// Holds each base: a link that hangs on nothing, or floats, and that joints hang on.
    pub(super) fn fix_bases(&mut self) {
        let bases = bases(&self.robot);
        let fixed = &self.fixed;
        self.fixed = held_links(&self.robot, |link| bases[link] || fixed.contains(&link));
    }
}

/// For each link, whether it is the base of a robot.
fn bases(robot: &Robot) -> Vec<bool> {
    let parents = robot.parent_joints();
    let order: Vec<usize> = robot.links_from_the_roots().into_iter().collect();
    let mut is_base = vec![false; robot.links.len()];
    let mut base_of: Vec<usize> = (0..robot.links.len()).collect();
    for link in order {
        match parents[link].map(|joint| &robot.joints[joint]) {
            None => {}
            Some(joint) if joint.kind == JointKind::Floating => {}
            Some(joint) => {
                base_of[link] = base_of[joint.parent];
                is_base[base_of[link]] |= joint.kind != JointKind::Fixed;
            }
        }
    }
    is_base
}
