//! Tubes of old scripts (`sim.tube*`): two ends with the same name, each with a queue of packets.
//!
//! A tube ends with the interpreter of the script that opened it.

use std::collections::{BTreeMap, VecDeque};

/// All open ends, by handle.
#[derive(Default)]
pub(super) struct Tubes {
    ends: BTreeMap<i64, End>,
    opened: i64,
}

struct End {
    key: (i64, Vec<u8>),
    /// The script that opened it.
    owner: i64,
    /// How many packets wait at most; 0: any number. The oldest one makes room.
    capacity: usize,
    partner: Option<i64>,
    packets: VecDeque<Vec<u8>>,
}

/// The result of `sim.tubeStatus`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TubeStatus {
    pub connected: bool,
    /// Packets that wait here.
    pub to_read: usize,
    /// Packets that wait at the other end.
    pub written: usize,
}

impl Tubes {
    /// Opens an end and connects it to a free one of that name.
    pub(super) fn open(&mut self, header: i64, name: Vec<u8>, capacity: usize, owner: i64) -> i64 {
        let handle = self.opened;
        self.opened += 1;
        let key = (header, name);
        let partner = self
            .ends
            .iter()
            .find(|(_, end)| end.partner.is_none() && end.key == key)
            .map(|(&h, _)| h);
        if let Some(other) = partner.and_then(|partner| self.ends.get_mut(&partner)) {
            other.partner = Some(handle);
        }
        self.ends.insert(
            handle,
            End {
                key,
                owner,
                capacity,
                partner,
                packets: VecDeque::new(),
            },
        );
        handle
    }

    /// Sends a packet to the other end; None if there is no such tube, false if it has no other end.
    pub(super) fn write(&mut self, handle: i64, packet: Vec<u8>) -> Option<bool> {
        let Some(partner) = self
            .ends
            .get(&handle)?
            .partner
            .and_then(|partner| self.ends.get_mut(&partner))
        else {
            return Some(false);
        };
        if partner.capacity > 0 && partner.packets.len() >= partner.capacity {
            partner.packets.pop_front();
        }
        partner.packets.push_back(packet);
        Some(true)
    }

    /// The oldest packet that waits.
    pub(super) fn read(&mut self, handle: i64) -> Option<Vec<u8>> {
        self.ends.get_mut(&handle)?.packets.pop_front()
    }

    pub(super) fn status(&self, handle: i64) -> Option<TubeStatus> {
        let end = self.ends.get(&handle)?;
        let partner = end.partner.and_then(|partner| self.ends.get(&partner));
        let written = partner.map_or(0, |partner| partner.packets.len());
        Some(TubeStatus {
            connected: partner.is_some(),
            to_read: end.packets.len(),
            written,
        })
    }

    /// Closes an end and disconnects the other one. False if there was none.
    pub(super) fn close(&mut self, handle: i64) -> bool {
        let Some(end) = self.ends.remove(&handle) else {
            return false;
        };
        if let Some(partner) = end.partner.and_then(|partner| self.ends.get_mut(&partner)) {
            partner.partner = None;
        }
        true
    }

    pub(super) fn close_those_of(&mut self, script: i64) {
        let owned: Vec<i64> = self
            .ends
            .iter()
            .filter(|(_, end)| end.owner == script)
            .map(|(&h, _)| h)
            .collect();
        for handle in owned {
            self.close(handle);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{TubeStatus, Tubes};

    #[test]
    fn packets_come_in_order_and_the_oldest_makes_room() {
        let mut tubes = Tubes::default();
        let a = tubes.open(7, b"name".to_vec(), 2, 1);
        assert_eq!(tubes.write(a, vec![0]), Some(false));
        let (_, b) = (
            tubes.open(7, b"other".to_vec(), 0, 1),
            tubes.open(7, b"name".to_vec(), 0, 2),
        );
        (1..=3).for_each(|n| assert_eq!(tubes.write(b, vec![n]), Some(true)));
        assert_eq!(
            tubes.status(b),
            Some(TubeStatus {
                connected: true,
                to_read: 0,
                written: 2
            })
        );
        assert_eq!(
            [tubes.read(a), tubes.read(a), tubes.read(a)],
            [Some(vec![2]), Some(vec![3]), None]
        );
        tubes.close_those_of(2);
        assert_eq!(tubes.status(a).map(|status| status.connected), Some(false));
        assert_eq!(
            (tubes.close(b), tubes.write(b, vec![]), tubes.read(b)),
            (false, None, None)
        );
    }
}
