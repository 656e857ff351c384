//! Which things hang together.

use std::collections::BTreeMap;

/// The group of each tie: ties with a common end are in the same group. Groups are numbered by their first tie.
pub fn partition<K: Ord>(
    ties: impl IntoIterator<Item = impl IntoIterator<Item = K>>,
) -> Vec<usize> {
    let (mut leaders, mut known) = (Vec::new(), BTreeMap::new());
    for (tie, ends) in ties.into_iter().enumerate() {
        leaders.push(tie);
        for end in ends {
            let other = *known.entry(end).or_insert(tie);
            let (a, b) = (leader(&mut leaders, tie), leader(&mut leaders, other));
            leaders[a.max(b)] = a.min(b);
        }
    }
    let mut numbers = BTreeMap::new();
    (0..leaders.len())
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
        let ties = [vec![1], vec![2, 3], vec![4], vec![3, 1], vec![5, 4]];
        assert_eq!(partition(ties), [0, 0, 1, 0, 1]);
        assert_eq!(partition([[0; 0], []]), [0, 1]);
    }
}
