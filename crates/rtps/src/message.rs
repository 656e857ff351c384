//! Reading of messages: a header, and submessages one after the other (DDSI-RTPS 2.3, 9.4).
//!
//! A submessage that is damaged ends the message; one of an unknown kind is left out.

use crate::bytes::Input;
use crate::guid::{EntityId, Guid, Prefix, SampleIdentity};
use crate::parameters::{Parameters, pid};

/// Time in the protocol: seconds of 1970 and fractions of 2^-32 s.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, PartialOrd, Ord)]
pub struct Timestamp {
    /// Seconds since 1970.
    pub seconds: u32,
    /// Of 2^-32 s.
    pub fraction: u32,
}

/// The head of a message, and what it contains.
pub(crate) struct Message<'a> {
    pub(crate) vendor: [u8; 2],
    pub(crate) prefix: Prefix,
    rest: &'a [u8],
}

/// What a writer says beside a payload.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct InlineQos {
    pub(crate) key: Option<Guid>,
    /// Bit 0: disposed, bit 1: unregistered.
    pub(crate) status: u32,
    pub(crate) related: Option<SampleIdentity>,
}

#[derive(Debug)]
pub(crate) struct Data<'a> {
    pub(crate) reader: EntityId,
    pub(crate) writer: EntityId,
    pub(crate) sequence: i64,
    pub(crate) inline: InlineQos,
    pub(crate) payload: &'a [u8],
    pub(crate) is_key: bool,
}

#[derive(Debug)]
pub(crate) struct DataFragments<'a> {
    pub(crate) reader: EntityId,
    pub(crate) writer: EntityId,
    pub(crate) sequence: i64,
    /// Number of the first fragment, from 1.
    pub(crate) first: u32,
    pub(crate) count: u32,
    pub(crate) fragment_size: usize,
    pub(crate) sample_size: usize,
    pub(crate) inline: InlineQos,
    pub(crate) payload: &'a [u8],
}

#[derive(Debug)]
pub(crate) enum Submessage<'a> {
    Data(Data<'a>),
    DataFragments(DataFragments<'a>),
    Heartbeat {
        reader: EntityId,
        writer: EntityId,
        first: i64,
        last: i64,
        is_final: bool,
    },
    AckNack {
        reader: EntityId,
        writer: EntityId,
        base: i64,
        missing: Vec<i64>,
        is_final: bool,
    },
    NackFragments {
        reader: EntityId,
        writer: EntityId,
        sequence: i64,
        missing: Vec<u32>,
    },
    /// Sequence numbers that will not come: from `first` to before `base`, and those of the list.
    Gap {
        reader: EntityId,
        writer: EntityId,
        first: i64,
        base: i64,
        more: Vec<i64>,
    },
    Timestamp(Option<Timestamp>),
    Destination(Prefix),
    Source {
        vendor: [u8; 2],
        prefix: Prefix,
    },
}

impl<'a> Message<'a> {
    /// None if this is no message of the protocol.
    pub(crate) fn parse(bytes: &'a [u8]) -> Option<Self> {
        let mut input = Input::new(bytes, true);
        if input.take(4)? != b"RTPS" || input.take(2)?[0] != 2 {
            return None;
        }
        Some(Self {
            vendor: input.array()?,
            prefix: input.array()?,
            rest: input.bytes,
        })
    }
}

impl<'a> Iterator for Message<'a> {
    type Item = Submessage<'a>;

    fn next(&mut self) -> Option<Submessage<'a>> {
        loop {
            let mut input = Input::new(self.rest, true);
            let [kind, flags] = input.array()?;
            input.little = flags & 1 != 0;
            let length = usize::from(input.u16()?);
            // Zero is "until the end", except for submessages that may be empty.
            let to_end = length == 0 && !matches!(kind, 0x01 | 0x09);
            let body = input.take(if to_end { input.bytes.len() } else { length })?;
            self.rest = input.bytes;
            match submessage(kind, flags, Input::new(body, input.little)) {
                Known::Yes(submessage) => return Some(submessage),
                Known::No => {}
                Known::Damaged => return None,
            }
        }
    }
}

enum Known<'a> {
    Yes(Submessage<'a>),
    No,
    Damaged,
}

fn submessage(kind: u8, flags: u8, input: Input<'_>) -> Known<'_> {
    let parsed = match kind {
        0x06 => acknack(flags, input),
        0x07 => heartbeat(flags, input),
        0x08 => gap(input),
        0x09 => timestamp(flags, input),
        0x0c => source(input),
        0x0e => destination(input),
        0x12 => nack_fragments(input),
        0x15 => data(flags, input),
        0x16 => data_fragments(flags, input),
        _ => return Known::No,
    };
    parsed.map_or(Known::Damaged, Known::Yes)
}

fn entities(input: &mut Input) -> Option<(EntityId, EntityId)> {
    Some((EntityId(input.array()?), EntityId(input.array()?)))
}

fn heartbeat(flags: u8, mut input: Input<'_>) -> Option<Submessage<'_>> {
    let (reader, writer) = entities(&mut input)?;
    let (first, last) = (input.sequence()?, input.sequence()?);
    input.u32()?;
    let is_valid = first >= 1 && last >= 0 && last >= first - 1;
    is_valid.then_some(Submessage::Heartbeat {
        reader,
        writer,
        first,
        last,
        is_final: flags & 2 != 0,
    })
}

fn acknack(flags: u8, mut input: Input<'_>) -> Option<Submessage<'_>> {
    let (reader, writer) = entities(&mut input)?;
    let (base, missing) = sequence_set(&mut input)?;
    input.u32()?;
    Some(Submessage::AckNack {
        reader,
        writer,
        base,
        missing,
        is_final: flags & 2 != 0,
    })
}

fn gap(mut input: Input<'_>) -> Option<Submessage<'_>> {
    let (reader, writer) = entities(&mut input)?;
    let first = input.sequence()?;
    let (base, more) = sequence_set(&mut input)?;
    (first >= 1).then_some(Submessage::Gap {
        reader,
        writer,
        first,
        base,
        more,
    })
}

fn nack_fragments(mut input: Input<'_>) -> Option<Submessage<'_>> {
    let (reader, writer) = entities(&mut input)?;
    let sequence = input.sequence()?;
    let base = input.u32()?;
    let missing = bits(&mut input)?
        .into_iter()
        .filter_map(|bit| base.checked_add(bit))
        .collect();
    Some(Submessage::NackFragments {
        reader,
        writer,
        sequence,
        missing,
    })
}

/// A set of sequence numbers: its base, and its members.
fn sequence_set(input: &mut Input) -> Option<(i64, Vec<i64>)> {
    let base = input.sequence().filter(|base| *base >= 0)?;
    let members = bits(input)?
        .into_iter()
        .filter_map(|bit| base.checked_add(i64::from(bit)))
        .collect();
    Some((base, members))
}

/// The bits that are set, of at most 256, the highest of each word first.
fn bits(input: &mut Input) -> Option<Vec<u32>> {
    let count = input.u32().filter(|count| *count <= 256)?;
    let words: Vec<u32> = (0..count.div_ceil(32))
        .map(|_| input.u32())
        .collect::<Option<_>>()?;
    Some(
        (0..count)
            .filter(|bit| words[(bit / 32) as usize] & (1 << (31 - bit % 32)) != 0)
            .collect(),
    )
}

fn timestamp(flags: u8, mut input: Input<'_>) -> Option<Submessage<'_>> {
    if flags & 2 != 0 {
        return Some(Submessage::Timestamp(None));
    }
    Some(Submessage::Timestamp(Some(Timestamp {
        seconds: input.u32()?,
        fraction: input.u32()?,
    })))
}

fn destination(mut input: Input<'_>) -> Option<Submessage<'_>> {
    Some(Submessage::Destination(input.array()?))
}

fn source(mut input: Input<'_>) -> Option<Submessage<'_>> {
    input.take(6)?;
    Some(Submessage::Source {
        vendor: input.array()?,
        prefix: input.array()?,
    })
}

/// Reader, writer and sequence number of data, and what follows the fixed part.
fn data_head<'a>(input: &mut Input<'a>) -> Option<(EntityId, EntityId, i64, Input<'a>)> {
    input.take(2)?;
    let to_inline = usize::from(input.u16()?);
    let mut rest = *input;
    rest.take(to_inline)?;
    let (reader, writer) = entities(input)?;
    let sequence = input.sequence().filter(|sequence| *sequence >= 1)?;
    Some((reader, writer, sequence, rest))
}

fn data(flags: u8, mut input: Input<'_>) -> Option<Submessage<'_>> {
    let (reader, writer, sequence, mut rest) = data_head(&mut input)?;
    let inline = if flags & 2 != 0 {
        inline_qos(&mut rest)?
    } else {
        InlineQos::default()
    };
    let has_payload = flags & 0x0c != 0;
    let payload = if has_payload { rest.bytes } else { &[] };
    Some(Submessage::Data(Data {
        reader,
        writer,
        sequence,
        inline,
        payload,
        is_key: flags & 8 != 0,
    }))
}

fn data_fragments(flags: u8, mut input: Input<'_>) -> Option<Submessage<'_>> {
    let (reader, writer, sequence, mut rest) = data_head(&mut input)?;
    let (first, count) = (input.u32()?, u32::from(input.u16()?));
    let (fragment_size, sample_size) = (usize::from(input.u16()?), input.u32()? as usize);
    let inline = if flags & 2 != 0 {
        inline_qos(&mut rest)?
    } else {
        InlineQos::default()
    };
    let payload = rest.bytes;
    let is_valid = first >= 1 && count >= 1 && fragment_size >= 1 && sample_size >= 1;
    is_valid.then_some(Submessage::DataFragments(DataFragments {
        reader,
        writer,
        sequence,
        first,
        count,
        fragment_size,
        sample_size,
        inline,
        payload,
    }))
}

fn inline_qos(input: &mut Input) -> Option<InlineQos> {
    let parameters = Parameters::take(input)?;
    let key = parameters
        .bytes(pid::KEY_HASH)
        .and_then(|bytes| bytes.try_into().ok())
        .map(Guid::from_bytes);
    // The status is always in big-endian order.
    let status = parameters
        .bytes(pid::STATUS_INFO)
        .and_then(|bytes| Input::new(bytes, false).u32())
        .unwrap_or(0);
    let related = [
        pid::RELATED_SAMPLE_IDENTITY,
        pid::RELATED_SAMPLE_IDENTITY_OF_FAST_DDS,
    ]
    .into_iter()
    .find_map(|id| identity(Input::new(parameters.bytes(id)?, input.little)));
    Some(InlineQos {
        key,
        status,
        related,
    })
}

fn identity(mut input: Input) -> Option<SampleIdentity> {
    Some(SampleIdentity {
        guid: Guid::from_bytes(input.array()?),
        sequence: input.sequence()?,
    })
}
