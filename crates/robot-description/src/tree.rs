//! Which joints make the tree of a robot.

use crate::model::Robot;

impl Robot {
    /// For each link, the index of the joint that moves it. A joint whose child has one already, or that would close a loop, moves nothing.
    pub fn parent_joints(&self) -> Vec<Option<usize>> {
        let mut parents = vec![None; self.links.len()];
        let mut sets = Sets((0..self.links.len()).collect());
        for (index, joint) in self.joints.iter().enumerate() {
            if joint.parent.max(joint.child) >= self.links.len() || parents[joint.child].is_some() {
                continue;
            }
            if sets.unite(joint.parent, joint.child) {
                parents[joint.child] = Some(index);
            }
        }
        parents
    }

    /// The joints that close loops: what they connect is connected by others already.
    pub fn loop_joints(&self) -> Vec<usize> {
        let in_tree = self.parent_joints();
        let carries = |index: &usize| {
            self.joints[*index].child >= in_tree.len()
                || in_tree[self.joints[*index].child] != Some(*index)
        };
        (0..self.joints.len()).filter(carries).collect()
    }

    /// The links in an order in which parents come before what hangs on them.
    pub fn links_from_the_roots(&self) -> Vec<usize> {
        let parents = self.parent_joints();
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); self.links.len()];
        for joint in parents.iter().flatten().map(|index| &self.joints[*index]) {
            children[joint.parent].push(joint.child);
        }
        let mut order: Vec<usize> = (0..self.links.len())
            .filter(|link| parents[*link].is_none())
            .collect();
        let mut next = 0;
        while let Some(link) = order.get(next).copied() {
            order.append(&mut children[link]);
            next += 1;
        }
        order
    }
}

/// Which links are connected.
struct Sets(Vec<usize>);

impl Sets {
    fn of(&mut self, mut link: usize) -> usize {
        while self.0[link] != link {
            self.0[link] = self.0[self.0[link]];
            link = self.0[link];
        }
        link
    }

    /// False if both are connected already.
    fn unite(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.of(a), self.of(b));
        self.0[b] = a;
        a != b
    }
}
