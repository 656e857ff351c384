//! The protocol as a value: it takes datagrams and times and returns datagrams. The socket is somebody else's.

use std::collections::BTreeMap;
use std::net::{Ipv4Addr, SocketAddrV4};
use std::sync::Arc;
use std::time::Duration;

use crate::discovery::{Endpoint, OwnParticipant};
use crate::guid::{EntityId, Guid, Prefix};
use crate::message::{DataFragments, Message, Submessage, Timestamp};
use crate::peers::Peer;
use crate::qos::{Durability, History, Qos};
use crate::reader::{Reader, Sample, sample};
use crate::writer::{Change, Correlation, Writer};
use crate::{Datagram, Limits};

/// Time between two announcements of this participant; the first ones come faster.
const ANNOUNCE_PERIOD: Duration = Duration::from_secs(2);
const FIRST_ANNOUNCEMENTS: u32 = 5;
const FIRST_ANNOUNCE_PERIOD: Duration = Duration::from_millis(200);
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
        let places = [vec![self.multicast()], self.settings.announce_to.clone()].concat();
        self.outgoing.extend(places.into_iter().map(|to| Datagram {
            to,
            bytes: bytes.clone(),
        }));
    }

    pub(crate) fn multicast(&self) -> SocketAddrV4 {
        SocketAddrV4::new(
            MULTICAST,
            u16::try_from(multicast_port(self.settings.domain)).unwrap_or(u16::MAX),
        )
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

    /// Takes a datagram. What is no message of the protocol, or not for this participant, has no effect.
    pub fn receive(&mut self, datagram: &[u8], from: SocketAddrV4, now: Duration) {
        self.now = now;
        let Some(message) = Message::parse(datagram) else {
            return;
        };
        let mut sender = Sender {
            prefix: message.prefix,
            vendor: message.vendor,
            from,
            time: None,
        };
        let mut is_for_us = true;
        for submessage in message {
            match submessage {
                Submessage::Destination(prefix) => {
                    is_for_us = prefix == self.settings.prefix || prefix == [0; 12]
                }
                Submessage::Source { vendor, prefix } => {
                    (sender.vendor, sender.prefix) = (vendor, prefix)
                }
                Submessage::Timestamp(time) => sender.time = time,
                _ if !is_for_us || sender.prefix == self.settings.prefix => {}
                other => self.submessage(other, sender),
            }
        }
        self.read_discovery();
    }

    fn submessage(&mut self, submessage: Submessage, sender: Sender) {
        let guid = |entity| Guid {
            prefix: sender.prefix,
            entity,
        };
        let out = &mut self.outgoing;
        match submessage {
            Submessage::Data(data) if data.writer == EntityId::PARTICIPANTS_WRITER => {
                self.participant_data(&data, sender)
            }
            Submessage::Data(data) => {
                let sample = sample(
                    guid(data.writer),
                    data.sequence,
                    sender.time,
                    data.payload.to_vec(),
                    &data.inline,
                );
                let sample = if data.is_key { sample.of_key() } else { sample };
                for reader in readers_of(&mut self.readers, data.reader, guid(data.writer)) {
                    reader.receive(guid(data.writer), sample.clone());
                }
            }
            Submessage::DataFragments(data) => self.fragments(&data, sender),
            Submessage::Heartbeat {
                reader,
                writer,
                first,
                last,
                is_final,
            } => {
                for reader in readers_of(&mut self.readers, reader, guid(writer)) {
                    reader.heartbeat(guid(writer), first, last, is_final, out);
                }
            }
            Submessage::Gap {
                reader,
                writer,
                first,
                base,
                more,
            } => {
                for reader in readers_of(&mut self.readers, reader, guid(writer)) {
                    reader.gap(guid(writer), first, base, &more);
                }
            }
            Submessage::AckNack {
                reader,
                writer,
                base,
                missing,
                is_final,
            } => {
                if let Some(writer) = self.writers.get_mut(&writer) {
                    writer.acknowledged(guid(reader), base, &missing, is_final, out);
                }
            }
            Submessage::NackFragments {
                reader,
                writer,
                sequence,
                missing,
            } => {
                if let Some(writer) = self.writers.get_mut(&writer) {
                    writer.resend_fragments(guid(reader), sequence, &missing, out);
                }
            }
            Submessage::Destination(_) | Submessage::Source { .. } | Submessage::Timestamp(_) => {}
        }
    }

    fn fragments(&mut self, data: &DataFragments, sender: Sender) {
        let writer = Guid {
            prefix: sender.prefix,
            entity: data.writer,
        };
        for reader in readers_of(&mut self.readers, data.reader, writer) {
            reader.receive_fragments(writer, data, sender.time);
        }
    }
}

/// Where a message came from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sender {
    pub(crate) prefix: Prefix,
    pub(crate) vendor: [u8; 2],
    pub(crate) from: SocketAddrV4,
    time: Option<Timestamp>,
}

/// The reader that is addressed, or all that know the writer.
fn readers_of(
    readers: &mut BTreeMap<EntityId, Reader>,
    addressed: EntityId,
    writer: Guid,
) -> impl Iterator<Item = &mut Reader> {
    readers
        .iter_mut()
        .filter(move |(entity, reader)| {
            (addressed == EntityId::UNKNOWN || **entity == addressed) && reader.has_writer(writer)
        })
        .map(|(_, reader)| reader)
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
