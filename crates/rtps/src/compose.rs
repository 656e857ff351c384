//! Writing of messages, in little-endian order.

use crate::bytes::push_sequence;
use crate::guid::{EntityId, Guid, Prefix, SampleIdentity};
use crate::message::Timestamp;
use crate::parameters::{ParameterList, pid};

/// This protocol's vendor has no number.
pub(crate) const VENDOR: [u8; 2] = [0, 0];
pub(crate) const VERSION: [u8; 2] = [2, 3];

/// What is said beside a payload.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Beside {
    /// An instance that has ended, of the protocol's own topics.
    pub(crate) ended: Option<Guid>,
    pub(crate) related: Option<SampleIdentity>,
}

/// Data and where it belongs.
pub(crate) struct DataHead {
    pub(crate) reader: EntityId,
    pub(crate) writer: EntityId,
    pub(crate) sequence: i64,
    pub(crate) beside: Beside,
}

/// A message that grows by submessages.
pub(crate) struct Composer(Vec<u8>);

impl Composer {
    pub(crate) fn new(from: Prefix) -> Self {
        let mut bytes = b"RTPS".to_vec();
        bytes.extend_from_slice(&VERSION);
        bytes.extend_from_slice(&VENDOR);
        bytes.extend_from_slice(&from);
        Self(bytes)
    }

    pub(crate) fn to(from: Prefix, to: Prefix) -> Self {
        let mut message = Self::new(from);
        message.submessage(0x0e, 0, &[&to]);
        message
    }

    fn submessage(&mut self, kind: u8, flags: u8, parts: &[&[u8]]) {
        let length: usize = parts.iter().map(|part| part.len()).sum();
        let padded = length.next_multiple_of(4);
        self.0.extend_from_slice(&[kind, flags | 1]);
        // A length that does not fit is zero: "until the end", so it is the last one.
        self.0
            .extend_from_slice(&u16::try_from(padded).unwrap_or(0).to_le_bytes());
        parts.iter().for_each(|part| self.0.extend_from_slice(part));
        self.0.resize(self.0.len() + padded - length, 0);
    }

    pub(crate) fn timestamp(&mut self, time: Timestamp) {
        self.submessage(
            0x09,
            0,
            &[&time.seconds.to_le_bytes(), &time.fraction.to_le_bytes()],
        );
    }

    pub(crate) fn data(&mut self, head: &DataHead, payload: &[u8]) {
        let inline = inline_qos(&head.beside);
        let kind = if head.beside.ended.is_some() {
            0x08
        } else {
            0x04
        };
        let flags = kind | if inline.is_empty() { 0 } else { 0x02 };
        let fixed = data_head(head, 16);
        self.submessage(0x15, flags, &[&fixed, &inline, payload]);
    }

    /// One fragment, with its number from 1.
    pub(crate) fn fragment(&mut self, head: &DataHead, sample: &[u8], size: usize, number: u32) {
        let inline = inline_qos(&head.beside);
        let flags = if inline.is_empty() { 0 } else { 0x02 };
        let mut fixed = data_head(head, 28);
        fixed.extend_from_slice(&number.to_le_bytes());
        fixed.extend_from_slice(&1u16.to_le_bytes());
        fixed.extend_from_slice(&(size as u16).to_le_bytes());
        fixed.extend_from_slice(&(sample.len() as u32).to_le_bytes());
        let start = (number as usize - 1) * size;
        let end = (start + size).min(sample.len());
        self.submessage(
            0x16,
            flags,
            &[&fixed, &inline, sample.get(start..end).unwrap_or_default()],
        );
    }

    pub(crate) fn heartbeat(
        &mut self,
        ends: (EntityId, EntityId),
        first: i64,
        last: i64,
        count: u32,
        is_final: bool,
    ) {
        let mut body = entities(ends);
        push_sequence(&mut body, first);
        push_sequence(&mut body, last);
        body.extend_from_slice(&count.to_le_bytes());
        self.submessage(0x07, u8::from(is_final) << 1, &[&body]);
    }

    pub(crate) fn acknack(
        &mut self,
        ends: (EntityId, EntityId),
        base: i64,
        missing: &[i64],
        count: u32,
        is_final: bool,
    ) {
        let mut body = entities(ends);
        push_set(&mut body, base, missing);
        body.extend_from_slice(&count.to_le_bytes());
        self.submessage(0x06, u8::from(is_final) << 1, &[&body]);
    }

    pub(crate) fn nack_fragments(
        &mut self,
        ends: (EntityId, EntityId),
        sequence: i64,
        missing: &[u32],
        count: u32,
    ) {
        let mut body = entities(ends);
        push_sequence(&mut body, sequence);
        let base = missing.first().copied().unwrap_or(1);
        body.extend_from_slice(&base.to_le_bytes());
        push_bits(&mut body, missing.iter().map(|number| number - base));
        body.extend_from_slice(&count.to_le_bytes());
        self.submessage(0x12, 0, &[&body]);
    }

    /// What will not come: from `first` to before `base`, and the ones of the list.
    pub(crate) fn gap(&mut self, ends: (EntityId, EntityId), first: i64, base: i64, more: &[i64]) {
        let mut body = entities(ends);
        push_sequence(&mut body, first);
        push_set(&mut body, base, more);
        self.submessage(0x08, 0, &[&body]);
    }

    pub(crate) fn finish(self) -> Vec<u8> {
        self.0
    }
}

fn entities((reader, writer): (EntityId, EntityId)) -> Vec<u8> {
    [reader.0, writer.0].concat()
}

fn data_head(head: &DataHead, to_inline: u16) -> Vec<u8> {
    let mut fixed = vec![0, 0];
    fixed.extend_from_slice(&to_inline.to_le_bytes());
    fixed.extend_from_slice(&entities((head.reader, head.writer)));
    push_sequence(&mut fixed, head.sequence);
    fixed
}

fn inline_qos(beside: &Beside) -> Vec<u8> {
    let mut list = ParameterList::default();
    if let Some(ended) = beside.ended {
        list.push(pid::KEY_HASH, &ended.to_bytes());
        list.push(pid::STATUS_INFO, &[0, 0, 0, 3]);
    }
    if let Some(related) = beside.related {
        let mut identity = related.guid.to_bytes().to_vec();
        push_sequence(&mut identity, related.sequence);
        list.push(pid::RELATED_SAMPLE_IDENTITY, &identity);
        list.push(pid::RELATED_SAMPLE_IDENTITY_OF_FAST_DDS, &identity);
    }
    let is_empty = beside.ended.is_none() && beside.related.is_none();
    if is_empty { Vec::new() } else { list.finish() }
}

/// A set of at most 256 sequence numbers from `base` on.
fn push_set(body: &mut Vec<u8>, base: i64, members: &[i64]) {
    push_sequence(body, base);
    push_bits(
        body,
        members
            .iter()
            .filter_map(|member| u32::try_from(member - base).ok()),
    );
}

fn push_bits(body: &mut Vec<u8>, members: impl Iterator<Item = u32>) {
    let members: Vec<u32> = members.filter(|member| *member < 256).collect();
    let count = members.iter().max().map_or(0, |max| max + 1);
    let mut words = vec![0u32; count.div_ceil(32) as usize];
    for member in members {
        words[(member / 32) as usize] |= 1 << (31 - member % 32);
    }
    body.extend_from_slice(&count.to_le_bytes());
    words
        .iter()
        .for_each(|word| body.extend_from_slice(&word.to_le_bytes()));
}
