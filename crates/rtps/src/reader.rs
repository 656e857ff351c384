//! A reader: what arrived from which writer, what is missing, and the queue of complete messages (DDSI-RTPS 2.3, 8.4.12).

use std::collections::{BTreeMap, VecDeque};
use std::net::SocketAddrV4;

use crate::compose::Composer;
use crate::discovery::Endpoint;
use crate::fragments::Assembly;
use crate::guid::{EntityId, Guid, Prefix};
use crate::message::{DataFragments, InlineQos, Timestamp};
use crate::qos::History;
use crate::{Datagram, Limits};

/// A message that was received.
#[derive(Debug, Clone)]
pub struct Sample {
    /// Who wrote it.
    pub writer: Guid,
    /// The writer's number of it.
    pub sequence: i64,
    /// When it was written, if the writer says so.
    pub time: Option<Timestamp>,
    /// With its head of four bytes.
    pub payload: Vec<u8>,
    /// What it says about its request, beside the payload.
    pub related: Option<crate::SampleIdentity>,
    /// Whether the writer puts the identity of requests at the start of the payload.
    pub has_call_header: bool,
    pub(crate) ended: Option<Guid>,
}

/// A writer elsewhere.
#[derive(Debug)]
struct WriterProxy {
    address: SocketAddrV4,
    is_cyclone: bool,
    is_reliable: bool,
    /// Whether messages from before this reader are wanted.
    wants_history: bool,
    /// What comes next; unknown until the writer says what it has.
    next: Option<i64>,
    early: BTreeMap<i64, Sample>,
    assemblies: BTreeMap<i64, Assembly>,
    acknacks: u32,
}

#[derive(Debug)]
pub(crate) struct Reader {
    pub(crate) endpoint: Endpoint,
    limits: Limits,
    depth: usize,
    writers: BTreeMap<Guid, WriterProxy>,
    queue: VecDeque<Sample>,
    queued_bytes: usize,
    /// Messages that were left out since the queue was full.
    pub(crate) dropped: u64,
}

impl Reader {
    pub(crate) fn new(endpoint: Endpoint, limits: Limits) -> Self {
        let depth = match endpoint.qos.history {
            History::KeepLast(depth) => depth.clamp(1, limits.max_messages),
            History::KeepAll => limits.max_messages,
        };
        Self {
            endpoint,
            limits,
            depth,
            writers: BTreeMap::new(),
            queue: VecDeque::new(),
            queued_bytes: 0,
            dropped: 0,
        }
    }

    pub(crate) fn entity(&self) -> EntityId {
        self.endpoint.guid.entity
    }

    pub(crate) fn writers(&self) -> usize {
        self.writers.len()
    }

    pub(crate) fn has_writer(&self, writer: Guid) -> bool {
        self.writers.contains_key(&writer)
    }

    pub(crate) fn has_writer_of(&self, prefix: Prefix) -> bool {
        self.writers.keys().any(|writer| writer.prefix == prefix)
    }

    /// Whether writers of that participant know this reader: those that are reliable have said to it what they have.
    pub(crate) fn is_known_to(&self, prefix: Prefix) -> bool {
        let mut its = self
            .writers
            .iter()
            .filter(|(writer, _)| writer.prefix == prefix);
        its.all(|(_, proxy)| !proxy.is_reliable || proxy.next.is_some())
    }

    pub(crate) fn add_writer(
        &mut self,
        writer: &Endpoint,
        address: SocketAddrV4,
        is_cyclone: bool,
        out: &mut Vec<Datagram>,
    ) {
        let is_reliable = self.endpoint.qos.is_reliable() && writer.qos.is_reliable();
        // A writer that keeps nothing for late readers has only what is not confirmed, perhaps written for this one.
        let wants_history = self.endpoint.qos.is_durable() || !writer.qos.is_durable();
        let proxy = WriterProxy {
            address,
            is_cyclone,
            is_reliable,
            wants_history,
            next: None,
            early: BTreeMap::new(),
            assemblies: BTreeMap::new(),
            acknacks: 0,
        };
        if self.writers.contains_key(&writer.guid) {
            return;
        }
        self.writers.insert(writer.guid, proxy);
        if is_reliable {
            self.acknowledge(writer.guid, None, out);
        }
    }

    pub(crate) fn remove_writers(&mut self, which: impl Fn(&Guid) -> bool) {
        self.writers.retain(|guid, _| !which(guid));
    }

    pub(crate) fn take(&mut self) -> Option<Sample> {
        let sample = self.queue.pop_front()?;
        self.queued_bytes -= sample.payload.len();
        Some(sample)
    }

    pub(crate) fn newest(&self) -> Option<&[u8]> {
        Some(&self.queue.back()?.payload)
    }

    pub(crate) fn waiting(&self) -> usize {
        self.queue.len()
    }

    /// Puts a complete message into the queue; the oldest ones give way to it.
    pub(crate) fn enqueue(&mut self, sample: Sample) {
        self.queued_bytes += sample.payload.len();
        self.queue.push_back(sample);
        while self.queue.len() > self.depth
            || (self.queued_bytes > self.limits.max_bytes && self.queue.len() > 1)
        {
            self.take();
            self.dropped += 1;
        }
    }

    /// A message in one piece.
    pub(crate) fn receive(&mut self, writer: Guid, mut sample: Sample) {
        let Some(proxy) = self.writers.get_mut(&writer) else {
            return;
        };
        sample.has_call_header = proxy.is_cyclone;
        let limits = self.limits;
        proxy.arrived(sample, &limits);
        self.deliver(writer);
    }

    /// Pieces of a message.
    pub(crate) fn receive_fragments(
        &mut self,
        writer: Guid,
        data: &DataFragments,
        time: Option<Timestamp>,
    ) {
        let limits = self.limits;
        let Some(proxy) = self.writers.get_mut(&writer) else {
            return;
        };
        if data.sample_size > limits.max_bytes || proxy.has(data.sequence) {
            return;
        }
        let assembly = proxy
            .assemblies
            .entry(data.sequence)
            .or_insert_with(|| Assembly::new(data));
        let payload = assembly.add(data);
        proxy.limit_assemblies(&limits);
        if let Some(payload) = payload {
            proxy.assemblies.remove(&data.sequence);
            let sample = sample(writer, data.sequence, time, payload, &data.inline);
            self.receive(writer, sample);
        }
    }

    /// A writer says what it has. Answers with what is missing.
    pub(crate) fn heartbeat(
        &mut self,
        writer: Guid,
        first: i64,
        last: i64,
        is_final: bool,
        out: &mut Vec<Datagram>,
    ) {
        let Some(proxy) = self
            .writers
            .get_mut(&writer)
            .filter(|proxy| proxy.is_reliable)
        else {
            return;
        };
        let start = if proxy.wants_history { first } else { last + 1 };
        // Samples that the writer no longer has are not waited for.
        let before = proxy.skip_to(proxy.next.map_or(start, |next| next.max(first)));
        let is_first = proxy.acknacks <= 1;
        before.into_iter().for_each(|sample| self.enqueue(sample));
        self.deliver(writer);
        let is_complete = self
            .writers
            .get(&writer)
            .and_then(|proxy| proxy.next)
            .is_some_and(|next| next > last);
        if is_first || !is_final || !is_complete {
            self.acknowledge(writer, Some(last), out);
        }
    }

    /// A writer says what will not come.
    pub(crate) fn gap(&mut self, writer: Guid, first: i64, base: i64, more: &[i64]) {
        let Some(proxy) = self.writers.get_mut(&writer) else {
            return;
        };
        let mut before = Vec::new();
        if proxy.next.is_some_and(|next| first <= next) {
            before = proxy.skip_to(base);
        }
        for sequence in more {
            if proxy.next == Some(*sequence) {
                before.extend(proxy.skip_to(sequence + 1));
            }
        }
        before.into_iter().for_each(|sample| self.enqueue(sample));
        self.deliver(writer);
    }

    /// Moves what is complete and in order into the queue.
    fn deliver(&mut self, writer: Guid) {
        let Some(proxy) = self.writers.get_mut(&writer) else {
            return;
        };
        let mut ready = Vec::new();
        while let Some(sample) = proxy.next.and_then(|next| proxy.early.remove(&next)) {
            proxy.next = Some(sample.sequence + 1);
            ready.push(sample);
        }
        ready.into_iter().for_each(|sample| self.enqueue(sample));
    }

    /// Says what is here and what is missing up to `last`. An answer is required only if something is missing, and at the beginning, when
    /// nobody has said what there is: if each side answered the other, that would never end.
    fn acknowledge(&mut self, writer: Guid, last: Option<i64>, out: &mut Vec<Datagram>) {
        let own = self.endpoint.guid;
        let Some(proxy) = self.writers.get_mut(&writer) else {
            return;
        };
        let base = proxy.next.unwrap_or(1);
        let end = last.unwrap_or(0).min(base + 255);
        let absent: Vec<i64> = (base..=end)
            .filter(|sequence| !proxy.early.contains_key(sequence))
            .collect();
        let (partial, missing): (Vec<i64>, Vec<i64>) = absent
            .into_iter()
            .partition(|sequence| proxy.assemblies.contains_key(sequence));
        proxy.acknacks = proxy.acknacks.wrapping_add(1);
        let ends = (own.entity, writer.entity);
        let mut message = Composer::to(own.prefix, writer.prefix);
        let is_final = missing.is_empty() && last.is_some();
        message.acknack(ends, base, &missing, proxy.acknacks, is_final);
        for sequence in partial.into_iter().take(8) {
            if let Some(assembly) = proxy.assemblies.get(&sequence) {
                message.nack_fragments(ends, sequence, &assembly.missing(), proxy.acknacks);
            }
        }
        out.push(Datagram {
            to: proxy.address,
            bytes: message.finish(),
        });
    }
}

impl WriterProxy {
    /// Whether a message is here already, or is not wanted any more.
    fn has(&self, sequence: i64) -> bool {
        self.next.is_some_and(|next| sequence < next) || self.early.contains_key(&sequence)
    }

    fn arrived(&mut self, sample: Sample, limits: &Limits) {
        if self.has(sample.sequence) {
            return;
        }
        self.assemblies.remove(&sample.sequence);
        // Where nothing is sent again, what comes is what there is. So it is at the beginning, if no history is wanted.
        let is_unordered = !self.is_reliable
            || (self.next.is_none() && (!self.wants_history || sample.sequence == 1));
        if is_unordered {
            self.next = Some(sample.sequence);
        }
        self.early.insert(sample.sequence, sample);
        if self.early.len() > limits.max_messages.max(256) {
            // The writer does not send what is missing: the latest ones give way, and can be asked for again.
            self.early.pop_last();
        }
    }

    /// Nothing before `sequence` is awaited any more. Returns what had arrived of it, in order.
    fn skip_to(&mut self, sequence: i64) -> Vec<Sample> {
        if self.next.is_some_and(|next| next >= sequence) {
            return Vec::new();
        }
        self.next = Some(sequence);
        self.assemblies = self.assemblies.split_off(&sequence);
        let later = self.early.split_off(&sequence);
        std::mem::replace(&mut self.early, later)
            .into_values()
            .collect()
    }

    fn limit_assemblies(&mut self, limits: &Limits) {
        while self.assemblies.len() > 16
            || self.assemblies.values().map(Assembly::size).sum::<usize>() > limits.max_bytes
        {
            if self.assemblies.pop_first().is_none() {
                return;
            }
        }
    }
}

impl Sample {
    /// Only the key of an instance, in place of a payload: the instance has ended.
    pub(crate) fn of_key(mut self) -> Self {
        self.ended = self.ended.or_else(|| Endpoint::parse_key(&self.payload));
        self
    }
}

pub(crate) fn sample(
    writer: Guid,
    sequence: i64,
    time: Option<Timestamp>,
    payload: Vec<u8>,
    inline: &InlineQos,
) -> Sample {
    let ended = if inline.status & 3 != 0 {
        inline.key
    } else {
        None
    };
    Sample {
        writer,
        sequence,
        time,
        payload,
        related: inline.related,
        has_call_header: false,
        ended,
    }
}
