//! Sets of numbers that lie close together.

use std::collections::BTreeMap;

/// A set of numbers, kept as runs of consecutive numbers, so that the next number outside of it is found at once.
#[derive(Debug, Default)]
pub(super) struct NumberRuns {
    /// The first number of each run, and the last one.
    runs: BTreeMap<u64, u64>,
}

impl NumberRuns {
    pub(super) fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// The smallest number from `begin` on that is not in the set.
    pub(super) fn first_free(&self, begin: u64) -> u64 {
        match self.run_with(begin) {
            Some((_, last)) => last.saturating_add(1),
            None => begin,
        }
    }

    pub(super) fn insert(&mut self, number: u64) {
        if self.run_with(number).is_some() {
            return;
        }
        let before = number
            .checked_sub(1)
            .and_then(|before| self.run_with(before));
        let after = number
            .checked_add(1)
            .and_then(|after| self.runs.remove(&after));
        let first = before.map_or(number, |(first, _)| first);
        self.runs.insert(first, after.unwrap_or(number));
    }

    pub(super) fn remove(&mut self, number: u64) {
        let Some((first, last)) = self.run_with(number) else {
            return;
        };
        self.runs.remove(&first);
        if first < number {
            self.runs.insert(first, number - 1);
        }
        if number < last {
            self.runs.insert(number + 1, last);
        }
    }

    fn run_with(&self, number: u64) -> Option<(u64, u64)> {
        let (&first, &last) = self.runs.range(..=number).next_back()?;
        (number <= last).then_some((first, last))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use test_support::random::Random;

    #[test]
    fn free_numbers_are_those_outside() {
        let mut random = Random::new(1);
        let (mut runs, mut expected) = (NumberRuns::default(), BTreeSet::new());
        for _ in 0..3000 {
            let (number, begin) = (random.below(40) as u64, random.below(45) as u64);
            if random.below(3) > 0 {
                runs.insert(number);
                expected.insert(number);
            } else {
                runs.remove(number);
                expected.remove(&number);
            }
            let free = (begin..).find(|number| !expected.contains(number));
            assert_eq!(Some(runs.first_free(begin)), free);
            assert_eq!(runs.is_empty(), expected.is_empty());
        }
    }

    #[test]
    fn neighbours_are_one_run() {
        let mut runs = NumberRuns::default();
        (0..1000).for_each(|number| runs.insert(number * 7 % 1000));
        assert_eq!(runs.runs, BTreeMap::from([(0, 999)]));
        runs.insert(u64::MAX);
        assert_eq!(runs.first_free(u64::MAX), u64::MAX);
    }
}
