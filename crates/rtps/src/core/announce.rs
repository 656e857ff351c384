//! What is said without being asked: that this participant is here, and that its writers are alive.

use std::net::SocketAddrV4;
use std::time::Duration;

use super::{Core, LEASE, MULTICAST, multicast_port};
use crate::Datagram;
use crate::discovery::OwnParticipant;
use crate::guid::EntityId;
use crate::message::Timestamp;

/// Time between two announcements of this participant; the first ones come faster.
const ANNOUNCE_PERIOD: Duration = Duration::from_secs(2);
const FIRST_ANNOUNCEMENTS: u32 = 5;
const FIRST_ANNOUNCE_PERIOD: Duration = Duration::from_millis(200);

impl Core {
    /// Does what is due. Returns the time of the next call.
    pub fn tick(&mut self, now: Duration) -> Duration {
        self.now = now;
        self.forget_silent_peers();
        if now >= self.next_announcement {
            self.announce();
        }
        let liveliness = self.assert_liveliness();
        let mut next = self.next_announcement.min(liveliness);
        for writer in self.writers.values_mut() {
            if let Some(due) = writer.remind(now, &mut self.outgoing) {
                next = next.min(due);
            }
        }
        next
    }

    fn announce(&mut self) {
        self.announcements += 1;
        let is_first = self.announcements < FIRST_ANNOUNCEMENTS;
        self.next_announcement = self.now
            + if is_first {
                FIRST_ANNOUNCE_PERIOD
            } else {
                ANNOUNCE_PERIOD
            };
        let bytes = self.announcement(None);
        let unicast = self.settings.announce_to.iter().copied();
        let places = self.multicast().into_iter().chain(unicast);
        self.outgoing.extend(places.map(|to| Datagram {
            to,
            bytes: bytes.clone(),
        }));
    }

    /// Where everybody is reached, if that is used.
    pub(crate) fn multicast(&self) -> Option<SocketAddrV4> {
        let port = u16::try_from(multicast_port(self.settings.domain)).ok()?;
        let is_used = self.settings.has_multicast;
        is_used.then(|| SocketAddrV4::new(MULTICAST, port))
    }

    pub(crate) fn description(&self) -> Vec<u8> {
        let own = OwnParticipant {
            prefix: self.settings.prefix,
            domain: self.settings.domain,
            unicast: self.settings.unicast,
            multicast: self.multicast(),
            name: &self.settings.name,
            user_data: &self.settings.user_data,
            lease: LEASE,
        };
        own.payload()
    }

    /// Writers that are alive by themselves say so as often as their leases demand. Returns when next.
    fn assert_liveliness(&mut self) -> Duration {
        let leases = self
            .writers
            .values()
            .filter_map(|writer| writer.endpoint.qos.liveliness_lease);
        let Some(lease) = leases.min() else {
            return Duration::MAX;
        };
        if self.now >= self.next_liveliness {
            self.next_liveliness = self.now + lease.div_f64(3.0).max(Duration::from_millis(10));
            // Kind 1: automatic; then a sequence of no bytes, behind the head of little-endian CDR.
            let payload = [
                &[0, 1, 0, 0][..],
                &self.settings.prefix,
                &[0, 0, 0, 1],
                &[0; 4],
            ]
            .concat();
            if let Some(writer) = self.writers.get_mut(&EntityId::LIVELINESS_WRITER) {
                writer.forget(writer.last);
            }
            self.write_change(
                EntityId::LIVELINESS_WRITER,
                &payload.into(),
                None,
                Timestamp::default(),
                None,
            );
        }
        self.next_liveliness
    }
}
