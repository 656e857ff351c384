//! Other participants: how they are found, what they have, and when they are gone (DDSI-RTPS 2.3, 8.5.3 and 8.5.4).

use std::collections::BTreeMap;
use std::net::{Ipv4Addr, SocketAddrV4};
use std::time::Duration;

use crate::compose::{Beside, Composer, DataHead};
use crate::core::{Core, Sender, fits};
use crate::discovery::{Endpoint, ParticipantData};
use crate::guid::{EntityId, Guid, Prefix};
use crate::message::Data;
use crate::qos::{Durability, History, Qos};
use crate::writer::CYCLONE;

/// The protocol's own topics: the bit by which a participant says that it has the writer (the reader has the next one), and both ends.
const BUILTIN: [(u32, EntityId, EntityId); 3] = [
    (
        2,
        EntityId::PUBLICATIONS_WRITER,
        EntityId::PUBLICATIONS_READER,
    ),
    (
        4,
        EntityId::SUBSCRIPTIONS_WRITER,
        EntityId::SUBSCRIPTIONS_READER,
    ),
    (10, EntityId::LIVELINESS_WRITER, EntityId::LIVELINESS_READER),
];

/// Another participant.
#[derive(Debug)]
pub(crate) struct Peer {
    data: ParticipantData,
    /// Where it is reached.
    metatraffic: SocketAddrV4,
    unicast: SocketAddrV4,
    last_seen: Duration,
    endpoints: BTreeMap<Guid, Endpoint>,
}

impl Core {
    /// A participant announces itself, or its end.
    pub(crate) fn participant_data(&mut self, data: &Data, sender: Sender) {
        if data.inline.status & 3 != 0 || data.is_key {
            return self.remove_peer(sender.prefix);
        }
        if self.settings.is_alone {
            return;
        }
        let Some(described) =
            ParticipantData::parse(data.payload).filter(|data| data.prefix == sender.prefix)
        else {
            return;
        };
        let now = self.now;
        if let Some(peer) = self.peers.get_mut(&sender.prefix) {
            peer.last_seen = now;
            return;
        }
        let is_known_place = self.peers.len() < self.settings.limits.max_peers;
        let (Some(metatraffic), Some(unicast), true) = (
            self.reach(&described.metatraffic, sender.from),
            self.reach(&described.unicast, sender.from),
            is_known_place,
        ) else {
            return;
        };
        let peer = Peer {
            data: described,
            metatraffic,
            unicast,
            last_seen: now,
            endpoints: BTreeMap::new(),
        };
        self.peers.insert(sender.prefix, peer);
        // It learns of this participant at once, before it is sent anything else.
        let bytes = self.announcement(Some(sender.prefix));
        self.outgoing.push(crate::Datagram {
            to: metatraffic,
            bytes,
        });
        self.match_builtin(sender.prefix);
    }

    /// The address to use of those that a participant names. On the loopback it is reached there, whatever it says.
    fn reach(&self, named: &[SocketAddrV4], from: SocketAddrV4) -> Option<SocketAddrV4> {
        if self.settings.is_loopback_only {
            let here =
                |address: &SocketAddrV4| SocketAddrV4::new(Ipv4Addr::LOCALHOST, address.port());
            return from
                .ip()
                .is_loopback()
                .then(|| named.first().map(here))
                .flatten();
        }
        let is_possible =
            |address: &&SocketAddrV4| address.ip().is_loopback() == from.ip().is_loopback();
        named.iter().find(is_possible).or(named.first()).copied()
    }

    fn match_builtin(&mut self, prefix: Prefix) {
        let Some(peer) = self.peers.get(&prefix) else {
            return;
        };
        let (address, vendor, set) = (
            peer.metatraffic,
            peer.data.vendor,
            peer.data.builtin_endpoints,
        );
        for (bit, writer, reader) in BUILTIN {
            if set & (1 << (bit + 1)) != 0
                && let Some(own) = self.writers.get_mut(&writer)
            {
                own.add_reader(
                    &builtin(prefix, reader),
                    address,
                    vendor,
                    &mut self.outgoing,
                );
            }
            if set & (1 << bit) != 0
                && let Some(own) = self.readers.get_mut(&reader)
            {
                own.add_writer(&builtin(prefix, writer), address, false, &mut self.outgoing);
            }
        }
    }

    /// This participant's announcement, for everybody or for one.
    pub(crate) fn announcement(&self, to: Option<Prefix>) -> Vec<u8> {
        let own = self.settings.prefix;
        let mut message = to.map_or_else(|| Composer::new(own), |to| Composer::to(own, to));
        let head = DataHead {
            reader: EntityId::PARTICIPANTS_READER,
            writer: EntityId::PARTICIPANTS_WRITER,
            sequence: 1,
            beside: Beside::default(),
        };
        message.data(&head, &self.description());
        message.finish()
    }

    /// What peers are told when this participant ends.
    pub fn leave(&mut self) {
        let participant = self.guid(EntityId::PARTICIPANT);
        let mut message = Composer::new(self.settings.prefix);
        let head = DataHead {
            reader: EntityId::PARTICIPANTS_READER,
            writer: EntityId::PARTICIPANTS_WRITER,
            sequence: 2,
            beside: Beside {
                ended: Some(participant),
                related: None,
            },
        };
        let mut key = crate::parameters::ParameterList::default();
        key.push(
            crate::parameters::pid::PARTICIPANT_GUID,
            &participant.to_bytes(),
        );
        message.data(&head, &key.payload());
        let bytes = message.finish();
        let peers = self.peers.values().map(|peer| peer.metatraffic);
        let places: Vec<SocketAddrV4> = peers.chain(self.multicast()).collect();
        self.outgoing
            .extend(places.into_iter().map(|to| crate::Datagram {
                to,
                bytes: bytes.clone(),
            }));
    }

    fn remove_peer(&mut self, prefix: Prefix) {
        if self.peers.remove(&prefix).is_some() {
            self.writers
                .values_mut()
                .for_each(|writer| writer.remove_readers(|guid| guid.prefix == prefix));
            self.readers
                .values_mut()
                .for_each(|reader| reader.remove_writers(|guid| guid.prefix == prefix));
        }
    }

    pub(crate) fn forget_silent_peers(&mut self) {
        let now = self.now;
        let is_silent = |peer: &Peer| now.saturating_sub(peer.last_seen) > peer.data.lease;
        let silent: Vec<Prefix> = self
            .peers
            .iter()
            .filter(|(_, peer)| is_silent(peer))
            .map(|(p, _)| *p)
            .collect();
        silent
            .into_iter()
            .for_each(|prefix| self.remove_peer(prefix));
    }

    /// Reads what peers say of their endpoints.
    pub(crate) fn read_discovery(&mut self) {
        for reader in [
            EntityId::PUBLICATIONS_READER,
            EntityId::SUBSCRIPTIONS_READER,
        ] {
            while let Some(sample) = self.take(reader) {
                match (sample.ended, Endpoint::parse(&sample.payload)) {
                    (Some(guid), _) => self.endpoint_ended(guid),
                    (None, Some(endpoint)) => self.endpoint_found(sample.writer.prefix, endpoint),
                    (None, None) => {}
                }
            }
        }
        while self.take(EntityId::LIVELINESS_READER).is_some() {}
    }

    fn endpoint_found(&mut self, prefix: Prefix, endpoint: Endpoint) {
        let max = self.settings.limits.max_endpoints;
        let Some(peer) = self.peers.get_mut(&prefix) else {
            return;
        };
        if endpoint.guid.prefix != prefix
            || endpoint.guid.entity.is_builtin()
            || peer.endpoints.len() >= max
        {
            return;
        }
        peer.endpoints.insert(endpoint.guid, endpoint.clone());
        if endpoint.guid.entity.is_reader() {
            let fitting = self
                .writers
                .values()
                .filter(|writer| fits(&writer.endpoint, &endpoint));
            let writers: Vec<EntityId> = fitting.map(|writer| writer.entity()).collect();
            writers
                .into_iter()
                .for_each(|writer| self.match_reader(writer, &endpoint));
        } else {
            let fitting = self
                .readers
                .values()
                .filter(|reader| fits(&endpoint, &reader.endpoint));
            let readers: Vec<EntityId> = fitting.map(|reader| reader.entity()).collect();
            readers
                .into_iter()
                .for_each(|reader| self.match_writer(reader, &endpoint));
        }
    }

    fn endpoint_ended(&mut self, guid: Guid) {
        if let Some(peer) = self.peers.get_mut(&guid.prefix) {
            peer.endpoints.remove(&guid);
        }
        self.writers
            .values_mut()
            .for_each(|writer| writer.remove_readers(|other| *other == guid));
        self.readers
            .values_mut()
            .for_each(|reader| reader.remove_writers(|other| *other == guid));
    }

    pub(crate) fn match_own_writer(&mut self, entity: EntityId) {
        let Some(writer) = self.writers.get(&entity) else {
            return;
        };
        let known = self.peers.values().flat_map(|peer| peer.endpoints.values());
        let readers: Vec<Endpoint> = known
            .filter(|other| other.guid.entity.is_reader() && fits(&writer.endpoint, other))
            .cloned()
            .collect();
        readers
            .iter()
            .for_each(|reader| self.match_reader(entity, reader));
    }

    pub(crate) fn match_own_reader(&mut self, entity: EntityId) {
        let Some(reader) = self.readers.get(&entity) else {
            return;
        };
        let known = self.peers.values().flat_map(|peer| peer.endpoints.values());
        let writers: Vec<Endpoint> = known
            .filter(|other| !other.guid.entity.is_reader() && fits(other, &reader.endpoint))
            .cloned()
            .collect();
        writers
            .iter()
            .for_each(|writer| self.match_writer(entity, writer));
    }

    fn match_reader(&mut self, writer: EntityId, reader: &Endpoint) {
        if let Some((address, vendor)) = self.address_of(reader)
            && let Some(writer) = self
                .writers
                .get_mut(&writer)
                .filter(|writer| !writer.has_reader(reader.guid))
        {
            writer.add_reader(reader, address, vendor, &mut self.outgoing);
        }
    }

    fn match_writer(&mut self, reader: EntityId, writer: &Endpoint) {
        if let Some((address, vendor)) = self.address_of(writer)
            && let Some(reader) = self.readers.get_mut(&reader)
        {
            reader.add_writer(writer, address, vendor == CYCLONE, &mut self.outgoing);
        }
    }

    fn address_of(&self, endpoint: &Endpoint) -> Option<(SocketAddrV4, [u8; 2])> {
        let peer = self.peers.get(&endpoint.guid.prefix)?;
        let own = self.reach(&endpoint.unicast, peer.unicast);
        Some((own.unwrap_or(peer.unicast), peer.data.vendor))
    }

    /// The endpoints of programs elsewhere that are known.
    pub fn known_endpoints(&self) -> impl Iterator<Item = &Endpoint> {
        self.peers.values().flat_map(|peer| peer.endpoints.values())
    }

    /// How many other participants are known.
    pub fn peers(&self) -> usize {
        self.peers.len()
    }
}

fn builtin(prefix: Prefix, entity: EntityId) -> Endpoint {
    Endpoint {
        guid: Guid { prefix, entity },
        topic: String::new(),
        type_name: String::new(),
        qos: Qos {
            durability: Durability::TransientLocal,
            history: History::KeepAll,
            ..Qos::default()
        },
        user_data: Vec::new(),
        unicast: Vec::new(),
        is_plain_cdr: true,
    }
}
