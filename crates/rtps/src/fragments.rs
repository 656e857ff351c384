//! Messages that arrive in pieces.

use crate::message::DataFragments;

/// A message of which pieces are here.
#[derive(Debug)]
pub(crate) struct Assembly {
    bytes: Vec<u8>,
    fragment_size: usize,
    here: Vec<bool>,
    missing: usize,
}

impl Assembly {
    /// Memory is for what the sender announces; the caller limits that.
    pub(crate) fn new(data: &DataFragments) -> Self {
        let count = data.sample_size.div_ceil(data.fragment_size);
        Self {
            bytes: vec![0; data.sample_size],
            fragment_size: data.fragment_size,
            here: vec![false; count],
            missing: count,
        }
    }

    pub(crate) fn size(&self) -> usize {
        self.bytes.len()
    }

    /// Adds pieces. Returns the message when it is complete.
    pub(crate) fn add(&mut self, data: &DataFragments) -> Option<Vec<u8>> {
        if data.fragment_size != self.fragment_size || data.sample_size != self.bytes.len() {
            return None;
        }
        let mut payload = data.payload;
        for number in data.first..data.first.saturating_add(data.count) {
            let index = number as usize - 1;
            let start = index.checked_mul(self.fragment_size)?;
            let end = start.checked_add(self.fragment_size)?.min(self.bytes.len());
            let place = self.bytes.get_mut(start..end)?;
            let (piece, rest) = payload.split_at_checked(place.len())?;
            place.copy_from_slice(piece);
            payload = rest;
            self.missing -= usize::from(!std::mem::replace(self.here.get_mut(index)?, true));
        }
        (self.missing == 0).then(|| std::mem::take(&mut self.bytes))
    }

    /// The numbers of missing pieces, at most 256 after the first one.
    pub(crate) fn missing(&self) -> Vec<u32> {
        let absent = (1u32..)
            .zip(&self.here)
            .filter(|(_, here)| !**here)
            .map(|(number, _)| number);
        let numbers: Vec<u32> = absent.take(256).collect();
        let first = numbers.first().copied().unwrap_or(1);
        numbers
            .into_iter()
            .take_while(|number| number - first < 256)
            .collect()
    }
}
