//! The protocol as a value: it takes datagrams and times and returns datagrams. The socket is somebody else's.

mod announce;
mod receive;

use std::collections::BTreeMap;
use std::net::{Ipv4Addr, SocketAddrV4};
use std::sync::Arc;
use std::time::Duration;

use crate::discovery::Endpoint;
use crate::guid::{EntityId, Guid, Prefix};
use crate::message::Timestamp;
use crate::peers::Peer;
use crate::qos::{Durability, History, Qos};
use crate::reader::{Reader, Sample};
use crate::writer::{Change, Correlation, Writer};
use crate::{Datagram, Limits};
pub(crate) use receive::Sender;

/// How long peers believe in this participant without an announcement.
pub(crate) const LEASE: Duration = Duration::from_secs(20);
/// Where participants announce themselves (DDSI-RTPS 2.3, 9.6.1.4).
pub(crate) const MULTICAST: Ipv4Addr = Ipv4Addr::new(239, 255, 0, 1);

/// Who a participant is.
#[derive(Debug, Clone)]
pub struct CoreSettings {
    /// Its name in the domain, different from all others.
    pub prefix: Prefix,
    /// Participants of one domain find each other.
    pub domain: u32,
    /// Where it receives.
    pub unicast: SocketAddrV4,
    /// Where it announces itself, beside the multicast address.
    pub announce_to: Vec<SocketAddrV4>,
    /// Whether it announces itself by multicast, and receives what comes that way.
    pub has_multicast: bool,
    /// Whether nobody is to be found, whatever arrives.
    pub is_alone: bool,
    /// For people.
    pub name: String,
    /// For programs: ROS 2 has its enclave here.
    pub user_data: Vec<u8>,
    /// Whether only addresses of the loopback are used.
    pub is_loopback_only: bool,
    /// What is kept at most.
    pub limits: Limits,
}

/// A message to be written.
#[derive(Debug, Clone)]
pub struct Written {
    /// With its head of four bytes.
    pub payload: Arc<[u8]>,
    /// For requests and replies.
    pub call: Option<Correlation>,
    /// When it was written.
    pub time: Timestamp,
}

/// A participant without sockets.
#[derive(Debug)]
pub struct Core {
    pub(crate) settings: CoreSettings,
    pub(crate) writers: BTreeMap<EntityId, Writer>,
    pub(crate) readers: BTreeMap<EntityId, Reader>,
    pub(crate) peers: BTreeMap<Prefix, Peer>,
    pub(crate) outgoing: Vec<Datagram>,
    entities: u32,
    announcements: u32,
    next_announcement: Duration,
    next_liveliness: Duration,
    pub(crate) now: Duration,
    /// Which message announced a writer or reader of this side.
    announced: BTreeMap<EntityId, i64>,
}

/// The ports of a domain (DDSI-RTPS 2.3, 9.6.1.1).
pub(crate) fn multicast_port(domain: u32) -> u32 {
    7400 + 250 * domain
}

/// Of the participant with a number from 0.
pub(crate) fn unicast_port(domain: u32, participant: u32) -> u32 {
    7410 + 250 * domain + 2 * participant
}

impl Core {
    /// A participant that knows nobody.
    pub fn new(settings: CoreSettings) -> Self {
        let mut core = Self {
            settings,
            writers: BTreeMap::new(),
            readers: BTreeMap::new(),
            peers: BTreeMap::new(),
            outgoing: Vec::new(),
            entities: 0,
            announcements: 0,
            next_announcement: Duration::ZERO,
            next_liveliness: Duration::ZERO,
            now: Duration::ZERO,
            announced: BTreeMap::new(),
        };
        for entity in [
            EntityId::PUBLICATIONS_WRITER,
            EntityId::SUBSCRIPTIONS_WRITER,
            EntityId::LIVELINESS_WRITER,
        ] {
            let writer = Writer::new(core.builtin(entity), usize::MAX);
            core.writers.insert(entity, writer);
        }
        for entity in [
            EntityId::PUBLICATIONS_READER,
            EntityId::SUBSCRIPTIONS_READER,
            EntityId::LIVELINESS_READER,
        ] {
            let reader = Reader::new(core.builtin(entity), core.settings.limits);
            core.readers.insert(entity, reader);
        }
        core
    }

    /// An endpoint of the protocol's own topics: reliable, and late readers get everything.
    fn builtin(&self, entity: EntityId) -> Endpoint {
        let qos = Qos {
            durability: Durability::TransientLocal,
            history: History::KeepAll,
            ..Qos::default()
        };
        self.endpoint(entity, "", "", qos, &[])
    }

    fn endpoint(
        &self,
        entity: EntityId,
        topic: &str,
        type_name: &str,
        qos: Qos,
        user_data: &[u8],
    ) -> Endpoint {
        Endpoint {
            guid: Guid {
                prefix: self.settings.prefix,
                entity,
            },
            topic: topic.to_string(),
            type_name: type_name.to_string(),
            qos,
            user_data: user_data.to_vec(),
            unicast: vec![self.settings.unicast],
            is_plain_cdr: true,
        }
    }

    /// The name of an endpoint of this participant.
    pub fn guid(&self, entity: EntityId) -> Guid {
        Guid {
            prefix: self.settings.prefix,
            entity,
        }
    }

    /// What has to be sent.
    pub fn take_outgoing(&mut self) -> Vec<Datagram> {
        std::mem::take(&mut self.outgoing)
    }

    /// A new writer; its readers are found in the background. `user_data` is for programs.
    pub fn create_writer(
        &mut self,
        topic: &str,
        type_name: &str,
        qos: Qos,
        user_data: &[u8],
    ) -> EntityId {
        self.entities += 1;
        let entity = EntityId::user_writer(self.entities);
        let endpoint = self.endpoint(entity, topic, type_name, qos, user_data);
        self.announce_endpoint(&endpoint);
        self.writers.insert(
            entity,
            Writer::new(endpoint, self.settings.limits.max_messages),
        );
        self.match_own_writer(entity);
        entity
    }

    /// A new reader; its writers are found in the background.
    pub fn create_reader(
        &mut self,
        topic: &str,
        type_name: &str,
        qos: Qos,
        user_data: &[u8],
    ) -> EntityId {
        self.entities += 1;
        let entity = EntityId::user_reader(self.entities);
        let endpoint = self.endpoint(entity, topic, type_name, qos, user_data);
        self.announce_endpoint(&endpoint);
        let mut reader = Reader::new(endpoint, self.settings.limits);
        for writer in self.writers.values().filter(|_| qos.is_durable()) {
            if fits(&writer.endpoint, &reader.endpoint) {
                writer
                    .durable_history()
                    .for_each(|change| reader.enqueue(change.sample(writer.endpoint.guid)));
            }
        }
        self.readers.insert(entity, reader);
        self.match_own_reader(entity);
        entity
    }

    /// Ends a writer or reader.
    pub fn remove(&mut self, entity: EntityId) {
        if entity.is_builtin()
            || (self.writers.remove(&entity).is_none() && self.readers.remove(&entity).is_none())
        {
            return;
        }
        let guid = self.guid(entity);
        let announcer = announcer_of(entity);
        let ended = Some(guid);
        if let Some(sequence) = self.announced.remove(&entity)
            && let Some(writer) = self.writers.get_mut(&announcer)
        {
            writer.forget(sequence);
        }
        self.write_change(
            announcer,
            &Endpoint::key_payload(guid).into(),
            None,
            Timestamp::default(),
            ended,
        );
    }

    fn announce_endpoint(&mut self, endpoint: &Endpoint) {
        let entity = endpoint.guid.entity;
        let payload = endpoint.payload().into();
        if let Some(sequence) = self.write_change(
            announcer_of(entity),
            &payload,
            None,
            Timestamp::default(),
            None,
        ) {
            self.announced.insert(entity, sequence);
        }
    }

    /// Writes a message. Returns its number, `None` without such a writer.
    pub fn write(&mut self, writer: EntityId, written: &Written) -> Option<i64> {
        let sequence =
            self.write_change(writer, &written.payload, written.call, written.time, None)?;
        let endpoint = &self.writers.get(&writer)?.endpoint;
        let change = Change {
            sequence,
            time: written.time,
            payload: written.payload.clone(),
            ended: None,
            call: written.call,
        };
        for reader in self
            .readers
            .values_mut()
            .filter(|reader| fits(endpoint, &reader.endpoint))
        {
            reader.enqueue(change.sample(endpoint.guid));
        }
        Some(sequence)
    }

    /// The number of the next message of a writer.
    pub fn next_sequence(&self, writer: EntityId) -> i64 {
        self.writers
            .get(&writer)
            .map_or(1, |writer| writer.last + 1)
    }

    fn write_change(
        &mut self,
        writer: EntityId,
        payload: &Arc<[u8]>,
        call: Option<Correlation>,
        time: Timestamp,
        ended: Option<Guid>,
    ) -> Option<i64> {
        let writer = self.writers.get_mut(&writer)?;
        let sequence = writer.last + 1;
        writer.write(
            Change {
                sequence,
                time,
                payload: payload.clone(),
                ended,
                call,
            },
            &mut self.outgoing,
        );
        Some(sequence)
    }

    /// The next message that a reader has.
    pub fn take(&mut self, reader: EntityId) -> Option<Sample> {
        self.readers.get_mut(&reader)?.take()
    }

    /// How many messages wait in a reader.
    pub fn waiting(&self, reader: EntityId) -> usize {
        self.readers.get(&reader).map_or(0, Reader::waiting)
    }

    /// The payload of the newest message that waits in a reader, which goes on waiting.
    pub fn newest(&self, reader: EntityId) -> Option<&[u8]> {
        self.readers.get(&reader)?.newest()
    }

    /// How many messages a reader left out since its queue was full.
    pub fn dropped(&self, reader: EntityId) -> u64 {
        self.readers.get(&reader).map_or(0, |reader| reader.dropped)
    }

    /// How many readers a writer has, or writers a reader, here and elsewhere.
    pub fn matched(&self, entity: EntityId) -> usize {
        if let Some(writer) = self.writers.get(&entity) {
            let here = self
                .readers
                .values()
                .filter(|reader| fits(&writer.endpoint, &reader.endpoint))
                .count();
            return writer.readers() + here;
        }
        self.readers.get(&entity).map_or(0, |reader| {
            let here = self
                .writers
                .values()
                .filter(|writer| fits(&writer.endpoint, &reader.endpoint))
                .count();
            reader.writers() + here
        })
    }

    /// The identity of the participant.
    pub fn participant(&self) -> Guid {
        self.guid(EntityId::PARTICIPANT)
    }

    /// Changes whenever a reader or a writer begins or ends: how many there have been, and how many there are.
    pub fn generation(&self) -> (u32, usize) {
        (self.entities, self.readers.len() + self.writers.len())
    }

    /// The identities of all readers and writers of the program but these.
    pub fn identities(&self, hidden: &[EntityId]) -> [Vec<[u8; 16]>; 2] {
        let is_shown = |entity: &&EntityId| !entity.is_builtin() && !hidden.contains(entity);
        let bytes = |entity: &EntityId| self.guid(*entity).to_bytes();
        [
            self.readers.keys().filter(is_shown).map(bytes).collect(),
            self.writers.keys().filter(is_shown).map(bytes).collect(),
        ]
    }

    /// Whether one of these writers elsewhere writes what a reader reads.
    pub fn reads_any(&self, reader: EntityId, writers: &[[u8; 16]]) -> bool {
        let guids = || writers.iter().map(|bytes| Guid::from_bytes(*bytes));
        let reader = self.readers.get(&reader);
        reader.is_some_and(|reader| guids().any(|writer| reader.has_writer(writer)))
    }

    /// Whether a participant elsewhere reads `writer`, writes what `reader` reads, and knows that reader: an answer will not be lost.
    pub fn has_responder(&self, writer: EntityId, reader: EntityId) -> bool {
        let (Some(writer), Some(reader)) = (self.writers.get(&writer), self.readers.get(&reader))
        else {
            return false;
        };
        self.peers.keys().any(|prefix| {
            writer.has_reader_of(*prefix)
                && reader.has_writer_of(*prefix)
                && reader.is_known_to(*prefix)
        })
    }

    /// Whether a participant has both a reader of `writer` and a writer for `reader`: a server of a service, or a client.
    pub fn has_partner(&self, writer: EntityId, reader: EntityId) -> bool {
        let (Some(writer), Some(reader)) = (self.writers.get(&writer), self.readers.get(&reader))
        else {
            return false;
        };
        let answers_here = self
            .writers
            .values()
            .any(|other| fits(&other.endpoint, &reader.endpoint));
        let reads_here = self
            .readers
            .values()
            .any(|other| fits(&writer.endpoint, &other.endpoint));
        (answers_here && reads_here)
            || self
                .peers
                .keys()
                .any(|prefix| writer.has_reader_of(*prefix) && reader.has_writer_of(*prefix))
    }
}

/// Whether a reader gets what a writer writes.
pub(crate) fn fits(writer: &Endpoint, reader: &Endpoint) -> bool {
    writer.topic == reader.topic
        && writer.type_name == reader.type_name
        && !writer.topic.is_empty()
        && writer.is_plain_cdr
        && reader.is_plain_cdr
        && writer.qos.offers(&reader.qos)
}

/// Which of the protocol's own writers announces an endpoint.
fn announcer_of(entity: EntityId) -> EntityId {
    if entity.is_reader() {
        EntityId::SUBSCRIPTIONS_WRITER
    } else {
        EntityId::PUBLICATIONS_WRITER
    }
}
