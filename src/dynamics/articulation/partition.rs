//! Which links hang together.

use std::collections::BTreeMap;

/// The number of the group each tie belongs to, counted by the first tie of each: ties with a common end belong together.
pub(super) fn partition<K: Ord + Copy>(ties: &[[Option<K>; 2]]) -> Vec<usize> {
    let mut leaders: Vec<usize> = (0..ties.len()).collect();
    let mut known = BTreeMap::new();
    for (tie, ends) in ties.iter().enumerate() {
        for &end in ends.iter().flatten() {
            let other = *known.entry(end).or_insert(tie);
            let (a, b) = (leader(&mut leaders, tie), leader(&mut leaders, other));
            leaders[a.max(b)] = a.min(b);
        }
    }
    let mut numbers = BTreeMap::new();
    (0..ties.len())
        .map(|tie| {
            let (leader, next) = (leader(&mut leaders, tie), numbers.len());
            *numbers.entry(leader).or_insert(next)
        })
        .collect()
}

/// The first tie of a group, as far as it is known; the way there is made shorter.
fn leader(leaders: &mut [usize], mut tie: usize) -> usize {
    while leaders[tie] != tie {
        leaders[tie] = leaders[leaders[tie]];
        tie = leaders[tie];
    }
    tie
}

#[cfg(test)]
mod tests {
    use super::partition;

    #[test]
    fn ties_with_a_common_end_are_one_group() {
        let ties = [[None, Some(1)], [Some(2), Some(3)], [Some(4), None], [Some(3), Some(1)], [Some(5), Some(4)]];
        assert_eq!(partition(&ties), [0, 0, 1, 0, 1]);
        assert_eq!(partition::<u8>(&[[None, None], [None, None]]), [0, 1]);
    }
}
