//! After a sub-step: the bodies back where the links want them.

use nalgebra::Vector6;

use super::block_cholesky::Segment;
use super::chain::Chain;
use super::mover::{Mover, Place};
use super::node::Node;
use crate::dynamics::links::Links;
use crate::dynamics::world::World;

/// Gaps this small are none, metres and radians.
const CLOSED: f64 = 1e-9;
/// Gaps that should have been closed at once, metres and radians.
const WIDE: f64 = 1e-4;
/// How often the bodies may be put back in a sub-step.
const ROUNDS: usize = 8;
/// A step that closes less than this part of the gaps was made with forces that lead nowhere.
const PROGRESS: f64 = 0.75;
/// Where no forces close wide gaps, the motion is too fast for the step: bodies turn by no more than this in a sub-step then, radians,
/// lest energy comes from nowhere.
const RESOLVED_TURN: f64 = 0.1;

impl Chain {
    /// Puts the bodies back where the links want them: integration leaves them off by the curvature of their ways. The velocities
    /// learn of it, which makes the whole a SHAKE step and keeps the energy.
    pub(super) fn settle(&mut self, links: &Links, world: &mut World, step: f64) {
        let spins = self.far_spins(links, world, step);
        for (mover, spin) in self.movers.iter_mut().zip(spins) {
            let before = mover.pose.rotation;
            mover.forget_links(world);
            mover.place(world);
            mover.shift = Vector6::zeros();
            mover.turn_with_axis(spin, before, step);
        }
        let is_closed = self.close_gaps(links);
        let most = if is_closed { f64::MAX } else { RESOLVED_TURN / step };
        let learns = is_closed || !self.has_loops();
        self.movers.iter().for_each(|mover| mover.tell(world, step, learns, most));
    }

    /// Forces act along the links as they were. Where that leads nowhere, as near a position in which a loop can fold two ways, the bodies
    /// are taken back and pushed along the links as they are. False when wide gaps remain.
    fn close_gaps(&mut self, links: &Links) -> bool {
        let mut pushes = self.gaps(links);
        let mut wide = widest(&pushes);
        let mut is_current = false;
        let begin = (wide > WIDE && self.has_loops())
            .then(|| (wide, self.movers.iter().map(Mover::place_now).collect::<Vec<Place>>()));
        for _ in 0..ROUNDS {
            if wide < CLOSED || !wide.is_finite() {
                break;
            }
            let places: Vec<Place> = self.movers.iter().map(Mover::place_now).collect();
            let gaps = pushes.clone();
            self.matrix.solve(&self.pattern, &mut pushes);
            self.close(&pushes);
            pushes = self.gaps(links);
            let left = widest(&pushes);
            if left <= wide * (1.0 - PROGRESS) || is_current {
                (wide, is_current) = (left, false);
                continue;
            }
            self.movers.iter_mut().zip(places).for_each(|(mover, place)| mover.take_back(place));
            pushes = gaps;
            if !self.renew(links) {
                break;
            }
            is_current = true;
        }
        // What cannot be closed at all, as a loop that is too short, stays open.
        if let Some((_, places)) = begin.filter(|(before, _)| wide > before * (1.0 - PROGRESS)) {
            self.movers.iter_mut().zip(places).for_each(|(mover, place)| mover.take_back(place));
        }
        wide <= WIDE
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

fn widest(gaps: &[Segment]) -> f64 {
    gaps.iter().map(|gap| gap.amax()).fold(0.0, f64::max)
}
