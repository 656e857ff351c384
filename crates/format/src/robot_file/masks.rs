//! Respondable masks that let those links touch that may touch in a file.
//!
//! Shapes of one tree touch where their masks have a bit of the low byte in common, or their further bits, shapes of different trees where they have one of the high
//! byte. A bit is so a set of links that all touch each other: sets are chosen one after the other, each with as many pairs that
//! no set had before as a greedy search finds. Links that must not touch never have a bit in common.

use std::collections::BTreeMap;

use super::Import;
use scene::FURTHER_BITS;
use scene::shape::RespondableMask;

/// Bits of a byte of a mask.
const BITS: u32 = 8;
/// Links that a search begins at.
const MAX_BEGINNINGS: usize = 64;

/// With what a link touches others.
#[derive(Debug, Clone, Copy)]
pub(super) struct Masks {
    pub mask: RespondableMask,
    /// Further bits within its tree.
    pub further: i64,
}

/// What two links do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Relation {
    /// They touch, and no set has them yet.
    Open,
    /// They touch, and a set has them; or it does not matter whether they do.
    Free,
    /// They must not be in one set.
    Apart,
}

/// The relations of all links that are touched.
struct Relations {
    count: usize,
    of_pairs: Vec<Relation>,
}

impl Relations {
    fn new(count: usize, relation: impl Fn(usize, usize) -> Relation) -> Self {
        let pairs = (0..count * count).map(|at| (at / count, at % count));
        let of = |(a, b)| {
            if a == b {
                Relation::Free
            } else {
                relation(a, b)
            }
        };
        Self {
            count,
            of_pairs: pairs.map(of).collect(),
        }
    }

    fn row(&self, link: usize) -> &[Relation] {
        &self.of_pairs[link * self.count..][..self.count]
    }

    fn open_of(&self, link: usize) -> usize {
        let row = self.row(link).iter();
        row.filter(|relation| **relation == Relation::Open).count()
    }

    /// At most so many sets, as bits of each link.
    fn bits(&mut self, max_sets: u32) -> Vec<u64> {
        let mut bits = vec![0; self.count];
        for bit in 0..max_sets {
            let Some(set) = self.largest_set() else { break };
            for &link in &set {
                bits[link] |= 1 << bit;
                for &other in &set {
                    self.of_pairs[link * self.count + other] = Relation::Free;
                }
            }
        }
        bits
    }

    /// The set with the most open pairs that is found; None where no pair is open.
    fn largest_set(&self) -> Option<Vec<usize>> {
        let mut beginnings: Vec<usize> = (0..self.count)
            .filter(|link| self.open_of(*link) > 0)
            .collect();
        beginnings.sort_by_key(|link| (std::cmp::Reverse(self.open_of(*link)), *link));
        let sets = beginnings.iter().take(MAX_BEGINNINGS);
        let sets: Vec<(usize, Vec<usize>)> = sets.map(|link| self.set_from(*link)).collect();
        let most = sets.iter().map(|(pairs, _)| *pairs).max()?;
        sets.into_iter()
            .find(|(pairs, _)| *pairs == most)
            .map(|(_, set)| set)
    }

    /// A set that begins with a link, and its open pairs: always the link that adds the most is next.
    fn set_from(&self, first: usize) -> (usize, Vec<usize>) {
        let mut gains = vec![Some(0); self.count];
        let (mut set, mut pairs, mut next) = (Vec::new(), 0, Some((first, 0)));
        while let Some((link, gain)) = next {
            set.push(link);
            pairs += gain;
            gains[link] = None;
            for (sum, relation) in gains.iter_mut().zip(self.row(link)) {
                *sum = match relation {
                    Relation::Apart => None,
                    Relation::Open => sum.map(|sum| sum + 1),
                    Relation::Free => *sum,
                };
            }
            let candidates = gains.iter().enumerate();
            next = candidates
                .filter_map(|(link, gain)| Some((link, gain.filter(|gain| *gain > 0)?)))
                .max_by_key(|(link, gain)| (*gain, std::cmp::Reverse(*link)));
        }
        (pairs, set)
    }

    /// The pairs that touch and that no set has.
    fn open_pairs(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        (0..self.count).flat_map(move |a| {
            let is_open = move |b: &usize| self.row(a)[*b] == Relation::Open;
            (a + 1..self.count).filter(is_open).map(move |b| [a, b])
        })
    }
}

impl Import<'_> {
    /// The masks of the links that are touched, by link; none where the file does not say which of them touch.
    pub(super) fn masks_of_touching(&mut self) -> BTreeMap<usize, Masks> {
        let robot = self.robot;
        let links: Vec<usize> = (0..robot.links.len())
            .filter(|link| !robot.links[*link].collisions.is_empty())
            .collect();
        let Some([mut within, mut between]) = self.relations(&links) else {
            return BTreeMap::new();
        };
        let (low, high) = (within.bits(BITS + FURTHER_BITS), high_bytes(&mut between));
        let lost: Vec<[usize; 2]> = within.open_pairs().chain(between.open_pairs()).collect();
        if let Some(pair) = lost.first() {
            let [a, b] = pair.map(|at| &robot.links[links[at]].name);
            let others = lost.len() - 1;
            self.message(format!(
                "links '{a}' and '{b}', and {others} other pairs, do not touch each other: masks have no more bits"
            ));
        }
        let mask = |(low, high): (&u64, &u8)| Masks {
            mask: RespondableMask(i64::from(u16::from_le_bytes([low.to_le_bytes()[0], *high]))),
            further: (low >> BITS).cast_signed(),
        };
        let masks = low.iter().zip(&high).map(mask);
        links.iter().copied().zip(masks).collect()
    }

    /// The relations of links within trees, and of those of different trees; None where the file does not say which of them touch.
    fn relations(&self, links: &[usize]) -> Option<[Relations; 2]> {
        let pairs = self.model.touching.as_ref()?;
        let trees = self.collision_trees();
        let relation = |a: usize, b: usize, is_within: bool| {
            let (a, b) = (links[a], links[b]);
            // The other byte decides about them, or nothing.
            let is_other = (trees[a] == trees[b]) != is_within;
            let never_moves = self.is_fixed(a) && self.is_fixed(b);
            if is_other || never_moves {
                Relation::Free
            } else if pairs.binary_search(&[a.min(b), a.max(b)]).is_ok() {
                Relation::Open
            } else {
                Relation::Apart
            }
        };
        Some(
            [true, false]
                .map(|is_within| Relations::new(links.len(), |a, b| relation(a, b, is_within))),
        )
    }

    /// For each link the one whose shapes are the root of its tree where collisions are concerned.
    fn collision_trees(&self) -> Vec<usize> {
        let parents = self.robot.parent_joints();
        let mut trees: Vec<usize> = (0..self.robot.links.len()).collect();
        for link in self.robot.links_from_the_roots() {
            if let Some(joint) = parents[link]
                && !self.begins_collision_tree(link, Some(joint))
            {
                trees[link] = trees[self.robot.joints[joint].parent];
            }
        }
        trees
    }
}

/// The bytes between trees. What is in no set still touches what is not in the file: it has a bit that nothing has which it must not touch, or else all.
fn high_bytes(between: &mut Relations) -> Vec<u8> {
    let all_touch = !between.of_pairs.contains(&Relation::Apart);
    if all_touch {
        between.of_pairs.fill(Relation::Free);
        return vec![u8::MAX; between.count];
    }
    let bits = between.bits(BITS).into_iter();
    let mut bytes: Vec<u8> = bits.map(|bits| bits.to_le_bytes()[0]).collect();
    for link in 0..between.count {
        if bytes[link] == 0 {
            let is_free = |bit: &u8| {
                let row = between.row(link).iter().zip(&bytes);
                row.clone()
                    .all(|(relation, byte)| *relation != Relation::Apart || byte & bit == 0)
            };
            let bit = (0..BITS).map(|bit| 1 << bit).find(is_free);
            bytes[link] = bit.unwrap_or(u8::MAX);
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Links of a chain: neighbours do not touch.
    fn chain(count: usize) -> Relations {
        let relation = |a: usize, b: usize| {
            if a.abs_diff(b) == 1 {
                Relation::Apart
            } else {
                Relation::Open
            }
        };
        Relations::new(count, relation)
    }

    #[test]
    fn links_that_touch_share_a_bit_and_neighbours_do_not() {
        for count in 1..=12 {
            let bytes = chain(count).bits(8);
            for a in 0..count {
                for b in a + 1..count {
                    let touch = bytes[a] & bytes[b] != 0;
                    assert_eq!(touch, b - a > 1, "{a} and {b} of {count}: {bytes:?}");
                }
            }
        }
    }

    #[test]
    fn where_bits_are_missing_pairs_are_lost_and_none_are_added() {
        let mut relations = chain(100);
        let bytes = relations.bits(8);
        let lost: Vec<[usize; 2]> = relations.open_pairs().collect();
        assert!(
            !lost.is_empty() && lost.len() < 100 * 99 / 4,
            "{}",
            lost.len()
        );
        for a in 0..100 {
            for b in a + 1..100 {
                let touch = bytes[a] & bytes[b] != 0;
                assert_eq!(touch, b - a > 1 && !lost.contains(&[a, b]), "{a} and {b}");
            }
        }
    }

    #[test]
    fn further_bits_let_long_chains_touch() {
        let mut relations = chain(40);
        let bits = relations.bits(BITS + FURTHER_BITS);
        assert_eq!(relations.open_pairs().count(), 0);
        let touch = |a: usize, b: usize| bits[a] & bits[b] != 0;
        assert!((0..39).all(|a| !touch(a, a + 1)) && touch(0, 2) && touch(1, 39));
    }

    #[test]
    fn what_touches_nothing_of_its_file_has_a_bit_of_its_own() {
        // 0 and 1 touch, 2 and 3 nothing.
        let relation = |a: usize, b: usize| {
            if a + b == 1 {
                Relation::Open
            } else {
                Relation::Apart
            }
        };
        let bytes = high_bytes(&mut Relations::new(4, relation));
        assert_eq!(bytes, [1, 1, 2, 4]);
        let all = high_bytes(&mut Relations::new(2, |_, _| Relation::Open));
        assert_eq!(all, [u8::MAX; 2]);
    }
}
