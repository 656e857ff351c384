//! A writer: what it keeps, who reads it, and what must be sent to whom (DDSI-RTPS 2.3, 8.4.9).

use std::collections::{BTreeMap, VecDeque};
use std::net::SocketAddrV4;
use std::sync::Arc;
use std::time::Duration;

use crate::Datagram;
use crate::compose::{Beside, Composer, DataHead};
use crate::discovery::Endpoint;
use crate::guid::{EntityId, Guid, Prefix, SampleIdentity};
use crate::message::Timestamp;
use crate::qos::History;
use crate::reader::Sample;

/// Larger payloads are sent in fragments of this size.
const FRAGMENT: usize = 16_000;
/// Time between two reminders of what is not confirmed.
const HEARTBEAT_PERIOD: Duration = Duration::from_millis(50);
/// The vendor of CycloneDDS. ROS 2 puts the identity of requests into the payload there, elsewhere beside it.
pub(crate) const CYCLONE: [u8; 2] = [1, 0x10];

/// A message of a writer.
#[derive(Debug, Clone)]
pub(crate) struct Change {
    pub(crate) sequence: i64,
    pub(crate) time: Timestamp,
    /// With its head of four bytes.
    pub(crate) payload: Arc<[u8]>,
    /// Of an instance that has ended.
    pub(crate) ended: Option<Guid>,
    pub(crate) call: Option<Correlation>,
}

/// What makes a message a request or a reply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Correlation {
    /// What the message says about its request: for replies, the request's identity; for requests, the reader that waits.
    pub related: SampleIdentity,
    /// The same for peers that expect it at the start of the payload: an identity of the client, and its number of the request.
    pub header: (u64, i64),
}

/// A reader elsewhere.
#[derive(Debug)]
struct ReaderProxy {
    address: SocketAddrV4,
    is_reliable: bool,
    is_cyclone: bool,
    /// What came before does not concern it.
    first: i64,
    /// All up to this one are confirmed.
    acknowledged: i64,
}

#[derive(Debug)]
pub(crate) struct Writer {
    pub(crate) endpoint: Endpoint,
    pub(crate) last: i64,
    /// How many messages are kept.
    limit: usize,
    history: VecDeque<Change>,
    readers: BTreeMap<Guid, ReaderProxy>,
    heartbeats: u32,
    next_heartbeat: Duration,
}

impl Writer {
    pub(crate) fn new(endpoint: Endpoint, max_messages: usize) -> Self {
        let limit = match endpoint.qos.history {
            History::KeepLast(depth) => depth.clamp(1, max_messages),
            History::KeepAll => max_messages,
        };
        let history = VecDeque::new();
        Self {
            endpoint,
            last: 0,
            limit,
            history,
            readers: BTreeMap::new(),
            heartbeats: 0,
            next_heartbeat: Duration::ZERO,
        }
    }

    pub(crate) fn entity(&self) -> EntityId {
        self.endpoint.guid.entity
    }

    pub(crate) fn readers(&self) -> usize {
        self.readers.len()
    }

    pub(crate) fn has_reader(&self, reader: Guid) -> bool {
        self.readers.contains_key(&reader)
    }

    pub(crate) fn has_reader_of(&self, prefix: Prefix) -> bool {
        self.readers.keys().any(|reader| reader.prefix == prefix)
    }

    /// What late readers get.
    pub(crate) fn durable_history(&self) -> impl Iterator<Item = &Change> {
        self.history
            .iter()
            .filter(|_| self.endpoint.qos.is_durable())
    }

    pub(crate) fn add_reader(
        &mut self,
        reader: &Endpoint,
        address: SocketAddrV4,
        vendor: [u8; 2],
        out: &mut Vec<Datagram>,
    ) {
        let is_late = self.endpoint.qos.is_durable() && reader.qos.is_durable();
        let first = if is_late { 1 } else { self.last + 1 };
        let is_reliable = self.endpoint.qos.is_reliable() && reader.qos.is_reliable();
        let proxy = ReaderProxy {
            address,
            is_reliable,
            is_cyclone: vendor == CYCLONE,
            first,
            acknowledged: first - 1,
        };
        if self.readers.insert(reader.guid, proxy).is_some() {
            return;
        }
        if is_reliable {
            self.heartbeat(reader.guid, false, out);
        } else if is_late {
            let sequences: Vec<i64> = self.history.iter().map(|change| change.sequence).collect();
            sequences
                .into_iter()
                .for_each(|sequence| self.resend(reader.guid, sequence, None, out));
        }
    }

    pub(crate) fn remove_readers(&mut self, which: impl Fn(&Guid) -> bool) {
        self.readers.retain(|guid, _| !which(guid));
        self.trim();
    }

    /// Keeps a change and sends it to everybody who reads.
    pub(crate) fn write(&mut self, change: Change, out: &mut Vec<Datagram>) {
        self.last = change.sequence;
        let mut addressees: BTreeMap<Prefix, (SocketAddrV4, bool, bool)> = BTreeMap::new();
        for (guid, proxy) in &self.readers {
            let entry =
                addressees
                    .entry(guid.prefix)
                    .or_insert((proxy.address, proxy.is_cyclone, false));
            entry.2 |= proxy.is_reliable;
        }
        self.heartbeats = self.heartbeats.wrapping_add(1);
        let first = self
            .history
            .front()
            .map_or(change.sequence, |oldest| oldest.sequence);
        let heartbeat = (first, change.sequence, self.heartbeats);
        for (prefix, (address, is_cyclone, is_reliable)) in addressees {
            let to = Addressee {
                prefix,
                reader: EntityId::UNKNOWN,
                address,
                is_cyclone,
            };
            self.send(&change, to, is_reliable.then_some(heartbeat), None, out);
        }
        self.history.push_back(change);
        self.trim();
    }

    /// Forgets a change: it was replaced by a later one.
    pub(crate) fn forget(&mut self, sequence: i64) {
        self.history.retain(|change| change.sequence != sequence);
    }

    /// What is confirmed by all is not needed for late readers, if they get nothing.
    fn trim(&mut self) {
        if !self.endpoint.qos.is_durable() {
            let reliable = self.readers.values().filter(|proxy| proxy.is_reliable);
            let confirmed = reliable
                .map(|proxy| proxy.acknowledged)
                .min()
                .unwrap_or(self.last);
            while self
                .history
                .front()
                .is_some_and(|change| change.sequence <= confirmed)
            {
                self.history.pop_front();
            }
        }
        while self.history.len() > self.limit {
            self.history.pop_front();
        }
    }

    /// Answers a reader that says what it has and what it lacks.
    pub(crate) fn acknowledged(
        &mut self,
        reader: Guid,
        base: i64,
        missing: &[i64],
        is_final: bool,
        out: &mut Vec<Datagram>,
    ) {
        let last = self.last;
        let Some(proxy) = self.readers.get_mut(&reader) else {
            return;
        };
        let first = proxy.first;
        proxy.acknowledged = proxy.acknowledged.max((base - 1).min(last));
        if !is_final && missing.is_empty() {
            // A reader that has everything need not say so again.
            self.heartbeat(reader, base > last, out);
        }
        if base < first && base >= 1 {
            self.say_gap(reader, base, first, &[], out);
        }
        let wanted = missing
            .iter()
            .copied()
            .filter(|sequence| *sequence >= first && *sequence <= last);
        let (kept, gone): (Vec<i64>, Vec<i64>) =
            wanted.partition(|sequence| self.kept(*sequence).is_some());
        kept.into_iter()
            .for_each(|sequence| self.resend(reader, sequence, None, out));
        if let Some(first_gone) = gone.first() {
            self.say_gap(reader, *first_gone, first_gone + 1, &gone[1..], out);
        }
        self.trim();
    }

    pub(crate) fn resend_fragments(
        &self,
        reader: Guid,
        sequence: i64,
        missing: &[u32],
        out: &mut Vec<Datagram>,
    ) {
        self.resend(reader, sequence, Some(missing), out);
    }

    /// Reminds readers of what they have not confirmed. Returns when to do that again.
    pub(crate) fn remind(&mut self, now: Duration, out: &mut Vec<Datagram>) -> Option<Duration> {
        let behind: Vec<Guid> = self
            .readers
            .iter()
            .filter(|(_, proxy)| proxy.is_reliable && proxy.acknowledged < self.last)
            .map(|(guid, _)| *guid)
            .collect();
        if behind.is_empty() {
            return None;
        }
        if now >= self.next_heartbeat {
            self.next_heartbeat = now + HEARTBEAT_PERIOD;
            behind
                .into_iter()
                .for_each(|reader| self.heartbeat(reader, false, out));
        }
        Some(self.next_heartbeat)
    }

    fn kept(&self, sequence: i64) -> Option<&Change> {
        let index = self
            .history
            .binary_search_by_key(&sequence, |change| change.sequence)
            .ok()?;
        self.history.get(index)
    }

    fn heartbeat(&mut self, reader: Guid, is_final: bool, out: &mut Vec<Datagram>) {
        self.heartbeats = self.heartbeats.wrapping_add(1);
        let Some(proxy) = self.readers.get(&reader) else {
            return;
        };
        let first = self
            .history
            .front()
            .map_or(self.last + 1, |oldest| oldest.sequence);
        let mut message = Composer::to(self.endpoint.guid.prefix, reader.prefix);
        message.heartbeat(
            (reader.entity, self.entity()),
            first,
            self.last,
            self.heartbeats,
            is_final,
        );
        out.push(Datagram {
            to: proxy.address,
            bytes: message.finish(),
        });
    }

    fn say_gap(&self, reader: Guid, first: i64, base: i64, more: &[i64], out: &mut Vec<Datagram>) {
        let Some(proxy) = self.readers.get(&reader) else {
            return;
        };
        let mut message = Composer::to(self.endpoint.guid.prefix, reader.prefix);
        message.gap((reader.entity, self.entity()), first, base, more);
        out.push(Datagram {
            to: proxy.address,
            bytes: message.finish(),
        });
    }

    fn resend(
        &self,
        reader: Guid,
        sequence: i64,
        fragments: Option<&[u32]>,
        out: &mut Vec<Datagram>,
    ) {
        let (Some(proxy), Some(change)) = (self.readers.get(&reader), self.kept(sequence)) else {
            return;
        };
        let (address, is_cyclone) = (proxy.address, proxy.is_cyclone);
        let to = Addressee {
            prefix: reader.prefix,
            reader: reader.entity,
            address,
            is_cyclone,
        };
        self.send(change, to, None, fragments, out);
    }

    fn send(
        &self,
        change: &Change,
        to: Addressee,
        heartbeat: Option<(i64, i64, u32)>,
        fragments: Option<&[u32]>,
        out: &mut Vec<Datagram>,
    ) {
        let payload = change.payload_for(to.is_cyclone);
        let related = change
            .call
            .filter(|_| !to.is_cyclone)
            .map(|call| call.related);
        let beside = Beside {
            ended: change.ended,
            related,
        };
        let head = DataHead {
            reader: to.reader,
            writer: self.entity(),
            sequence: change.sequence,
            beside,
        };
        let count = if payload.len() > FRAGMENT {
            payload.len().div_ceil(FRAGMENT) as u32
        } else {
            0
        };
        for number in if count == 0 { 0..=0 } else { 1..=count } {
            if fragments.is_some_and(|fragments| !fragments.contains(&number)) {
                continue;
            }
            let mut message = Composer::to(self.endpoint.guid.prefix, to.prefix);
            message.timestamp(change.time);
            if number == 0 {
                message.data(&head, &payload);
            } else {
                message.fragment(&head, &payload, FRAGMENT, number);
            }
            if let Some((first, last, count_of_heartbeats)) = heartbeat.filter(|_| number == count)
            {
                message.heartbeat(
                    (to.reader, self.entity()),
                    first,
                    last,
                    count_of_heartbeats,
                    true,
                );
            }
            out.push(Datagram {
                to: to.address,
                bytes: message.finish(),
            });
        }
    }
}

#[derive(Clone, Copy)]
struct Addressee {
    prefix: Prefix,
    reader: EntityId,
    address: SocketAddrV4,
    is_cyclone: bool,
}

impl Change {
    /// As a reader of the same participant gets it.
    pub(crate) fn sample(&self, writer: Guid) -> Sample {
        Sample {
            writer,
            sequence: self.sequence,
            time: Some(self.time),
            payload: self.payload.to_vec(),
            related: self.call.map(|call| call.related),
            has_call_header: false,
            ended: None,
        }
    }

    /// Requests and replies begin with the header of the call where that is expected. It is 16 bytes long, so nothing behind it
    /// is aligned differently.
    fn payload_for(&self, is_cyclone: bool) -> Arc<[u8]> {
        let (Some(call), true, Some((head, body))) =
            (self.call, is_cyclone, self.payload.split_at_checked(4))
        else {
            return self.payload.clone();
        };
        let (client, number) = call.header;
        [head, &client.to_le_bytes(), &number.to_le_bytes(), body]
            .concat()
            .into()
    }
}
