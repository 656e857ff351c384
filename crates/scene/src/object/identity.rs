//! Persistent identifiers of objects, and the DNA shared by copies.
//!
//! Both come from the counter of unique identifiers, so that a run that is repeated gives the same ones.

use crate::Uid;

/// The text that stays with one object when it is saved: 16 hexadecimal digits.
pub(crate) fn persistent_uid(uid: Uid) -> String {
    format!("{:016X}", splitmix64(uid as u64))
}

/// 16 bytes that an object shares with its copies.
pub(crate) fn dna(uid: Uid) -> Vec<u8> {
    let half = splitmix64(!(uid as u64));
    [half, splitmix64(half)]
        .iter()
        .flat_map(|part| part.to_be_bytes())
        .collect()
}

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): one to one, so that no two counts meet.
fn splitmix64(count: u64) -> u64 {
    let mut z = count.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_differ_and_repeat() {
        assert_eq!(persistent_uid(7), persistent_uid(7));
        assert_ne!(persistent_uid(7), persistent_uid(8));
        assert_eq!((persistent_uid(0).len(), dna(0).len()), (16, 16));
        assert_ne!(dna(7), dna(8));
    }
}
