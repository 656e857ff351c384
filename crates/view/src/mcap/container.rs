//! The container of MCAP files: messages in chunks compressed by zstd, with an index (mcap.dev, "MCAP File Format").
//!
//! (The crate `mcap` brings thirty packages for what is a page here, and with serde's macros it has everything else built anew.)

use std::collections::BTreeMap;
use std::io::{Result, Write};

use ruzstd::encoding::{CompressionLevel, compress_to_vec};

const MAGIC: &[u8] = b"\x89MCAP0\r\n";
/// Bytes of messages in a chunk.
const CHUNK: usize = 1 << 20;
const COMPRESSION: &str = "zstd";

/// Kinds of records.
mod op {
    pub const HEADER: u8 = 0x01;
    pub const FOOTER: u8 = 0x02;
    pub const SCHEMA: u8 = 0x03;
    pub const CHANNEL: u8 = 0x04;
    pub const MESSAGE: u8 = 0x05;
    pub const CHUNK: u8 = 0x06;
    pub const MESSAGE_INDEX: u8 = 0x07;
    pub const CHUNK_INDEX: u8 = 0x08;
    pub const STATISTICS: u8 = 0x0b;
    pub const DATA_END: u8 = 0x0f;
}

/// Writes a file.
pub(super) struct Container<W> {
    out: W,
    place: u64,
    chunk: Vec<u8>,
    /// Time and place in the chunk of its messages, by channel.
    indexed: BTreeMap<u16, Vec<(u64, u64)>>,
    /// Schemas and channels, which the end of the file has again.
    definitions: Vec<u8>,
    schemas: u16,
    /// Messages of each channel.
    counts: Vec<u64>,
    chunk_indices: Vec<u8>,
    chunks: u32,
    /// Of all messages, nanoseconds.
    times: Option<(u64, u64)>,
    /// Of those in the chunk.
    chunk_times: Option<(u64, u64)>,
    sequence: u32,
}

impl<W: Write> Container<W> {
    pub(super) fn new(out: W) -> Result<Self> {
        let mut file = Self {
            out,
            place: 0,
            chunk: Vec::new(),
            indexed: BTreeMap::new(),
            definitions: Vec::new(),
            schemas: 0,
            counts: Vec::new(),
            chunk_indices: Vec::new(),
            chunks: 0,
            times: None,
            chunk_times: None,
            sequence: 0,
        };
        file.write(MAGIC)?;
        let header = [text(""), text("swanilda")].concat();
        file.write(&record(op::HEADER, &header))?;
        Ok(file)
    }

    fn write(&mut self, bytes: &[u8]) -> Result<()> {
        self.place += bytes.len() as u64;
        self.out.write_all(bytes)
    }

    /// Adds a channel of protocol buffers; its number.
    pub(super) fn add_channel(&mut self, topic: &str, schema: &str, descriptors: &[u8]) -> u16 {
        self.schemas += 1;
        let channel = self.counts.len() as u16;
        let of_schema = [
            &self.schemas.to_le_bytes()[..],
            &text(schema),
            &text("protobuf"),
            &bytes(descriptors),
        ]
        .concat();
        let schema_id = self.schemas.to_le_bytes();
        let of_channel = [
            &channel.to_le_bytes()[..],
            &schema_id,
            &text(topic),
            &text("protobuf"),
            &bytes(&[]),
        ]
        .concat();
        for defined in [
            record(op::SCHEMA, &of_schema),
            record(op::CHANNEL, &of_channel),
        ] {
            self.chunk.extend_from_slice(&defined);
            self.definitions.extend_from_slice(&defined);
        }
        self.counts.push(0);
        channel
    }

    /// Adds a message at a time in nanoseconds.
    pub(super) fn add(&mut self, channel: u16, time: u64, message: &[u8]) -> Result<()> {
        self.indexed
            .entry(channel)
            .or_default()
            .push((time, self.chunk.len() as u64));
        let head = [
            &channel.to_le_bytes()[..],
            &self.sequence.to_le_bytes(),
            &time.to_le_bytes(),
            &time.to_le_bytes(),
        ];
        self.chunk
            .extend(record(op::MESSAGE, &[&head.concat(), message].concat()));
        self.sequence = self.sequence.wrapping_add(1);
        self.counts[usize::from(channel)] += 1;
        for times in [&mut self.times, &mut self.chunk_times] {
            let (first, last) = times.unwrap_or((time, time));
            *times = Some((first.min(time), last.max(time)));
        }
        if self.chunk.len() >= CHUNK {
            self.end_chunk()
        } else {
            Ok(())
        }
    }

    fn end_chunk(&mut self) -> Result<()> {
        let Some((first, last)) = self.chunk_times.take() else {
            return Ok(());
        };
        let (start, records) = (self.place, std::mem::take(&mut self.chunk));
        let times = [first.to_le_bytes(), last.to_le_bytes()].concat();
        let size = (records.len() as u64).to_le_bytes();
        let sum = crc32fast::hash(&records).to_le_bytes();
        let compressed = compress_to_vec(records.as_slice(), CompressionLevel::Fastest);
        let compressed_size = (compressed.len() as u64).to_le_bytes();
        let head = [
            &times,
            &size[..],
            &sum,
            &text(COMPRESSION),
            &compressed_size,
        ]
        .concat();
        self.write(&record(op::CHUNK, &[head, compressed].concat()))?;
        let length = self.place - start;
        let mut places = Vec::new();
        for (channel, messages) in std::mem::take(&mut self.indexed) {
            places.extend([&channel.to_le_bytes()[..], &self.place.to_le_bytes()].concat());
            let entries: Vec<u8> = messages
                .iter()
                .flat_map(|(a, b)| [a.to_le_bytes(), b.to_le_bytes()].concat())
                .collect();
            self.write(&record(
                op::MESSAGE_INDEX,
                &[&channel.to_le_bytes()[..], &bytes(&entries)].concat(),
            ))?;
        }
        let indices = (self.place - start - length).to_le_bytes();
        let index = [
            &times,
            &start.to_le_bytes()[..],
            &length.to_le_bytes(),
            &bytes(&places),
            &indices,
            &text(COMPRESSION),
            &compressed_size,
            &size,
        ];
        self.chunk_indices
            .extend(record(op::CHUNK_INDEX, &index.concat()));
        self.chunks += 1;
        Ok(())
    }

    /// Completes the file.
    pub(super) fn finish(mut self) -> Result<()> {
        self.end_chunk()?;
        self.write(&record(op::DATA_END, &[0; 4]))?;
        let summary = self.place;
        let (first, last) = self.times.unwrap_or_default();
        let counts = (0u16..).zip(&self.counts).flat_map(|(channel, count)| {
            [&channel.to_le_bytes()[..], &count.to_le_bytes()].concat()
        });
        let statistics = [
            &u64::from(self.sequence).to_le_bytes()[..],
            &self.schemas.to_le_bytes(),
            &(self.counts.len() as u32).to_le_bytes(),
            &[0; 8],
            &self.chunks.to_le_bytes(),
            &first.to_le_bytes(),
            &last.to_le_bytes(),
            &bytes(&counts.collect::<Vec<_>>()),
        ];
        let parts = [
            std::mem::take(&mut self.definitions),
            std::mem::take(&mut self.chunk_indices),
        ];
        parts.iter().try_for_each(|part| self.write(part))?;
        self.write(&record(op::STATISTICS, &statistics.concat()))?;
        self.write(&record(
            op::FOOTER,
            &[&summary.to_le_bytes()[..], &[0; 12]].concat(),
        ))?;
        self.write(MAGIC)?;
        self.out.flush()
    }
}

fn record(op: u8, content: &[u8]) -> Vec<u8> {
    [&[op][..], &(content.len() as u64).to_le_bytes(), content].concat()
}

/// Bytes after their length.
fn bytes(content: &[u8]) -> Vec<u8> {
    [&(content.len() as u32).to_le_bytes()[..], content].concat()
}

fn text(text: &str) -> Vec<u8> {
    bytes(text.as_bytes())
}
