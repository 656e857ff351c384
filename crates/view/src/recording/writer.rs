//! Writes a recording. Each chunk is in the file as soon as it is complete.

use std::io::Write;

use super::chunk::{self, Content};
use super::{ChunkPlace, END, FILE_HEAD, Index, MAGIC, Mark, VERSION};
use crate::blobs::Blob;
use crate::mirror::Message;

/// Seconds of simulation in a chunk.
const CHUNK_DURATION: f64 = 1.0;
/// Bytes of a chunk, before compression.
const CHUNK_SIZE: usize = 4 << 20;

pub(crate) struct Writer<W> {
    file: W,
    /// Of the next byte in the file.
    place: u64,
    chunk: Vec<u8>,
    /// Of the first message of the chunk.
    begun: f64,
    index: Index,
}

impl<W: Write> Writer<W> {
    /// Begins a recording of the scene with that name; steps last `time_step` seconds.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn new(mut file: W, name: &str, time_step: f64) -> std::io::Result<Self> {
        file.write_all(MAGIC)?;
        file.write_all(&VERSION.to_le_bytes())?;
        file.write_all(&[0; 4])?;
        let index = Index {
            name: name.to_owned(),
            time_step,
            ..Index::default()
        };
        Ok(Self {
            file,
            place: FILE_HEAD,
            chunk: Vec::new(),
            begun: 0.0,
            index,
        })
    }

    /// Whether the next message shall be in another chunk.
    pub(crate) fn chunk_is_full(&self, time: f64) -> bool {
        // Times are sums of steps: differences below a microsecond are rounding errors.
        self.chunk.is_empty()
            || self.chunk.len() >= CHUNK_SIZE
            || time - self.begun > CHUNK_DURATION - 1e-6
    }

    /// Writes the chunk, so that the next message begins another one.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn end_chunk(&mut self) -> std::io::Result<()> {
        if self.chunk.is_empty() {
            return Ok(());
        }
        let chunk = std::mem::take(&mut self.chunk);
        let length = self.write_compressed(&chunk, self.begun)?;
        self.index.chunks.push(ChunkPlace {
            time: self.begun,
            place: self.place,
            length,
        });
        self.place += super::CHUNK_HEAD + u64::from(length);
        Ok(())
    }

    fn write_compressed(&mut self, bytes: &[u8], time: f64) -> std::io::Result<u32> {
        let compressed = chunk::compress(bytes);
        let length = u32::try_from(compressed.len()).map_err(std::io::Error::other)?;
        let mut all = Vec::with_capacity(compressed.len() + 16);
        all.extend(length.to_le_bytes());
        all.extend(crc32fast::hash(&compressed).to_le_bytes());
        all.extend(time.to_le_bytes());
        all.extend(compressed);
        // A chunk is written in one call, so that a run that is killed leaves only complete chunks.
        self.file.write_all(&all)?;
        self.file.flush()?;
        Ok(length)
    }

    /// Adds a blob, unless the file has it already.
    ///
    /// # Errors
    /// When it is too large.
    pub(crate) fn add_blob(&mut self, time: f64, blob: &Blob) -> std::io::Result<()> {
        let number = self.index.chunks.len();
        if self.index.blobs.contains_key(&blob.hash) {
            return Ok(());
        }
        self.index.blobs.insert(blob.hash, number);
        self.push(
            time,
            Content::Blob {
                hash: blob.hash.0,
                bytes: &blob.bytes,
            },
        )
    }

    /// Adds a message.
    ///
    /// # Errors
    /// When it is too long.
    pub(crate) fn add(&mut self, time: f64, message: &Message) -> std::io::Result<()> {
        match message {
            Message::Text(text) => self.push(time, Content::Text(text)),
            Message::Binary(bytes) => self.push(time, Content::Binary(bytes)),
        }
    }

    fn push(&mut self, time: f64, content: Content<'_>) -> std::io::Result<()> {
        if self.chunk.is_empty() {
            self.begun = time;
            if self.index.chunks.is_empty() {
                self.index.start = time;
            }
        }
        self.index.end = time;
        chunk::push(&mut self.chunk, time, content)
    }

    pub(crate) fn mark(&mut self, mark: Mark) {
        self.index.mark(mark);
    }

    /// Writes the rest and the index.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn finish(mut self) -> std::io::Result<W> {
        self.end_chunk()?;
        self.file.write_all(&0u32.to_le_bytes())?;
        let place = self.place + 4;
        let index = self.index.to_bytes();
        self.write_compressed(&index, self.index.end)?;
        self.file.write_all(&place.to_le_bytes())?;
        self.file.write_all(END)?;
        self.file.flush()?;
        Ok(self.file)
    }
}
