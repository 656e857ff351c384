//! The order of a tree: which joint leads from each body to the root.

use crate::joint::Joint;
use crate::linked_body::LinkedBody;
use crate::tree::{Link, Parent};

/// A tree that grows from its roots.
struct Growth<'a> {
    bodies: &'a [LinkedBody],
    joints: &'a [Joint],
    /// The joints at each body, with the side.
    at_body: Vec<Vec<(usize, usize)>>,
    reached: Vec<bool>,
    links: Vec<Link>,
}

/// The links of all bodies that move, tips first; None where a joint closes a loop. Roots are bodies that do not move, then those that carry
/// the last joints.
pub(crate) fn grown(bodies: &[LinkedBody], joints: &[Joint]) -> Option<Vec<Link>> {
    let mut at_body = vec![Vec::new(); bodies.len()];
    for (index, joint) in joints.iter().enumerate() {
        (0..2).for_each(|side| at_body[joint.body(side)].push((index, side)));
    }
    let mut growth = Growth {
        bodies,
        joints,
        at_body,
        reached: vec![false; bodies.len()],
        links: Vec::new(),
    };
    let fixed = (0..bodies.len()).filter(|&body| !bodies[body].is_dynamic());
    let bases = joints.iter().rev().map(|joint| joint.body(0));
    let roots: Vec<usize> = fixed.chain(bases).chain(0..bodies.len()).collect();
    roots.into_iter().all(|root| growth.grow(root)).then(|| {
        growth.links.reverse();
        growth.links
    })
}

impl Growth<'_> {
    /// Adds all that hangs on a root, breadth first; false where there is a loop.
    fn grow(&mut self, root: usize) -> bool {
        if std::mem::replace(&mut self.reached[root], true) {
            return true;
        }
        if self.bodies[root].is_dynamic() {
            self.links.push(Link::new(root, None, 6));
        }
        let mut known = vec![(root, None)];
        let mut next = 0;
        while let Some(&(body, arrived)) = known.get(next) {
            next += 1;
            for (joint, side) in std::mem::take(&mut self.at_body[body]) {
                if arrived == Some(joint) {
                    continue;
                }
                let beyond = self.joints[joint].body(1 - side);
                if !self.bodies[beyond].is_dynamic()
                    || std::mem::replace(&mut self.reached[beyond], true)
                {
                    return false;
                }
                self.links.push(self.link(beyond, joint, side));
                known.push((beyond, Some(joint)));
            }
        }
        true
    }

    /// The link of a body beyond a joint, of which the other body is at `side`.
    fn link(&self, body: usize, joint: usize, side: usize) -> Link {
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let of_joint = &self.joints[joint];
        Link::new(
            body,
            Some(Parent::new(joint, of_joint.body(side), sign)),
            of_joint.free_motions().count(),
        )
    }
}
