//! After a sub-step: the bodies back where the links want them.

use nalgebra::Vector6;

use super::Articulation;
use super::block_cholesky::Segment;
use super::node::Node;
use crate::dynamics::links::Links;
use crate::dynamics::world::World;

/// Gaps this small are none, metres and radians.
const CLOSED: f64 = 1e-9;
/// Gaps that should have been closed at once, metres and radians.
const WIDE: f64 = 1e-4;
/// How often the bodies may be put back in a sub-step.
const ROUNDS: usize = 6;
/// Where forces along the links as they were do not close wide gaps, the motion is too fast for the step: bodies turn by no more than
/// this in a sub-step then, radians, lest energy comes from nowhere.
const RESOLVED_TURN: f64 = 0.1;

impl Articulation {
    /// Puts the bodies back where the links want them: integration leaves them off by the curvature of their ways. The velocities
    /// learn of it, which makes the whole a SHAKE step and keeps the energy.
    pub(in crate::dynamics) fn settle(&mut self, links: &Links, world: &mut World, step: f64) {
        for mover in &mut self.movers {
            mover.place(world);
            mover.shift = Vector6::zeros();
        }
        let (mut before, mut unresolved) = (f64::INFINITY, false);
        for _ in 0..ROUNDS {
            let mut pushes = self.gaps(links);
            let widest = pushes.iter().map(|gap| gap.amax()).fold(0.0, f64::max);
            if widest < CLOSED || !widest.is_finite() {
                break;
            }
            // Forces act along the links as they were; only where that leads nowhere, as they are now.
            if widest > before / 4.0 {
                unresolved |= widest > WIDE;
                if !self.renew(links) {
                    break;
                }
            }
            before = widest;
            self.matrix.solve(&self.pattern, &mut pushes);
            self.close(&pushes);
        }
        let most = if unresolved { RESOLVED_TURN / step } else { f64::MAX };
        self.movers.iter().for_each(|mover| mover.tell(world, step, most));
    }

    fn gaps(&self, links: &Links) -> Vec<Segment> {
        let gap = |node: &Node| links.get(&node.link).map_or(Segment::zeros(), |link| node.gap(link, &self.movers));
        self.nodes.iter().map(gap).collect()
    }

    /// The system for where the bodies are now.
    fn renew(&mut self, links: &Links) -> bool {
        for node in &mut self.nodes {
            if let Some(link) = links.get(&node.link) {
                node.place(link, &self.movers);
            }
        }
        self.assemble();
        self.matrix.factorize(&self.pattern)
    }

    /// Moves the bodies as pushes along the rows against the gaps would.
    fn close(&mut self, pushes: &[Segment]) {
        let mut shifts = vec![Vector6::zeros(); self.movers.len()];
        for (node, push) in self.nodes.iter().zip(pushes) {
            for side in 0..2 {
                shifts[node.ends[side]] -= node.jacobians[side].transpose() * push;
            }
        }
        for (mover, push) in self.movers.iter_mut().zip(shifts).filter(|(mover, _)| mover.moves()) {
            mover.shift(&(mover.response * push));
        }
    }
}
