//! Values under rising numbers, of which one is found by its number or by its position.

/// So many values are kept in one piece at most.
const PIECE: usize = 512;

/// Values under numbers that rise with each new one, in that order. They lie in pieces, so that removing one does not move all behind it and
/// finding one by its position does not go past all before it.
#[derive(Debug, Clone)]
pub(crate) struct Numbered<T> {
    /// None is empty.
    pieces: Vec<Vec<(i64, T)>>,
}

impl<T> Default for Numbered<T> {
    fn default() -> Self {
        Self { pieces: Vec::new() }
    }
}

impl<T> Numbered<T> {
    /// Adds a value under a number above all others.
    pub(crate) fn push(&mut self, number: i64, value: T) {
        match self.pieces.last_mut().filter(|piece| piece.len() < PIECE) {
            Some(piece) => piece.push((number, value)),
            None => self.pieces.push(vec![(number, value)]),
        }
    }

    pub(crate) fn get(&self, number: i64) -> Option<&T> {
        let (piece, at) = self.place(number)?;
        Some(&self.pieces[piece][at].1)
    }

    pub(crate) fn get_mut(&mut self, number: i64) -> Option<&mut T> {
        let (piece, at) = self.place(number)?;
        Some(&mut self.pieces[piece][at].1)
    }

    pub(crate) fn remove(&mut self, number: i64) -> Option<T> {
        let (piece, at) = self.place(number)?;
        let (_, value) = self.pieces[piece].remove(at);
        self.join(piece);
        Some(value)
    }

    /// The value that so many others are before.
    pub(crate) fn nth(&self, mut position: usize) -> Option<&T> {
        for piece in &self.pieces {
            match piece.get(position) {
                Some((_, value)) => return Some(value),
                None => position -= piece.len(),
            }
        }
        None
    }

    pub(crate) fn values(&self) -> impl Iterator<Item = &T> + Clone {
        self.pieces.iter().flatten().map(|(_, value)| value)
    }

    pub(crate) fn into_values(self) -> impl Iterator<Item = T> {
        self.pieces.into_iter().flatten().map(|(_, value)| value)
    }

    pub(crate) fn len(&self) -> usize {
        self.pieces.iter().map(Vec::len).sum()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    fn place(&self, number: i64) -> Option<(usize, usize)> {
        let begins_later = |piece: &Vec<(i64, T)>| piece.first().is_some_and(|(n, _)| *n > number);
        let piece = self.pieces.partition_point(|piece| !begins_later(piece));
        let piece = piece.checked_sub(1)?;
        let at = self.pieces[piece].binary_search_by_key(&number, |(number, _)| *number);
        Some((piece, at.ok()?))
    }

    /// Joins a piece that has become small with the next one, so that there are not many small ones.
    fn join(&mut self, piece: usize) {
        let len = self.pieces[piece].len();
        let next = self.pieces.get(piece + 1).map_or(0, Vec::len);
        if len == 0 {
            self.pieces.remove(piece);
        } else if next > 0 && len + next <= PIECE / 2 {
            let next = self.pieces.remove(piece + 1);
            self.pieces[piece].extend(next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;
    use test_support::random::Random;

    #[test]
    fn values_are_found_by_number_and_by_position() {
        let mut random = Random::new(1);
        let (mut numbered, mut expected) = (Numbered::default(), BTreeMap::new());
        for number in 0..10_000 {
            numbered.push(number, number);
            expected.insert(number, number);
            let gone = random.below(number as usize + 1) as i64;
            if random.below(10) < 8 {
                assert_eq!(numbered.remove(gone), expected.remove(&gone));
            }
            assert_eq!(numbered.get(gone), expected.get(&gone));
        }
        assert!(numbered.values().eq(expected.values()));
        assert_eq!(numbered.len(), expected.len());
        let positions = (0..=expected.len()).map(|position| numbered.nth(position).copied());
        let all = expected.values().copied().map(Some);
        assert!(positions.eq(all.chain([None])));
        assert!(numbered.pieces.len() <= 4 * expected.len() / PIECE + 2);
        assert!(numbered.into_values().eq(expected.into_values()));
    }
}
