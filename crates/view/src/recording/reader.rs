//! Reads recordings, also damaged ones and those of runs that were killed.

use std::collections::BTreeMap;
use std::io::{Read, Seek, SeekFrom};

use serde_json::Value;

use super::chunk::{self, Content};
use super::{
    CHUNK_HEAD, ChunkPlace, END, FILE_END, FILE_HEAD, Index, MAGIC, MAX_CHUNK, Mark, MarkKind,
    RecordingError, VERSION,
};
use crate::blobs::Hash;

/// A recording that is being read.
pub struct Recording<R> {
    file: R,
    index: Index,
}

/// The head of a chunk.
struct Head {
    length: u32,
    sum: u32,
    time: f64,
}

impl<R: Read + Seek> Recording<R> {
    /// Opens a file. One without an end is read from the front.
    ///
    /// # Errors
    /// When it is no recording, or nothing can be read.
    pub fn open(mut file: R) -> Result<Self, RecordingError> {
        let length = file.seek(SeekFrom::End(0))?;
        check_head(&mut file)?;
        let index = match end_of_chunks(&mut file, length)? {
            Some((place, end)) => Index::from_bytes(&read_at(&mut file, place, length)?.1, end)?,
            None => scan(&mut file, length)?,
        };
        if index.chunks.is_empty() {
            return Err(RecordingError::Empty);
        }
        Ok(Self { file, index })
    }

    /// What the recording contains.
    pub fn index(&self) -> &Index {
        &self.index
    }

    /// The messages of a chunk, as bytes for [`messages`](super::messages).
    ///
    /// # Errors
    /// When there is no such chunk, or it is damaged.
    pub fn chunk(&mut self, number: usize) -> Result<Vec<u8>, RecordingError> {
        let place = self
            .index
            .chunks
            .get(number)
            .ok_or(RecordingError::Damaged("there is no such chunk"))?;
        let end = place.place + CHUNK_HEAD + u64::from(place.length);
        Ok(read_at(&mut self.file, place.place, end)?.1)
    }

    /// The bytes of a blob.
    ///
    /// # Errors
    /// When it is not there, or its chunk is damaged.
    pub(crate) fn blob(&mut self, hash: Hash) -> Result<Option<Vec<u8>>, RecordingError> {
        let Some(&number) = self.index.blobs.get(&hash) else {
            return Ok(None);
        };
        let chunk = self.chunk(number)?;
        for message in chunk::messages(&chunk) {
            match message?.content {
                Content::Blob { hash: this, bytes } if this == hash.0 => {
                    return Ok(Some(bytes.to_vec()));
                }
                _ => {}
            }
        }
        Ok(None)
    }
}

fn check_head(file: &mut (impl Read + Seek)) -> Result<(), RecordingError> {
    file.rewind()?;
    let mut head = [0; FILE_HEAD as usize];
    file.read_exact(&mut head)
        .map_err(|_| RecordingError::NoRecording)?;
    let [magic @ .., a, b, c, d, _, _, _, _] = head;
    match (magic == *MAGIC, u32::from_le_bytes([a, b, c, d])) {
        (false, _) => Err(RecordingError::NoRecording),
        (_, VERSION) => Ok(()),
        (_, version) => Err(RecordingError::Version(version)),
    }
}

/// The place of the index and the end of the chunks; None for a file without an end.
fn end_of_chunks(
    file: &mut (impl Read + Seek),
    length: u64,
) -> Result<Option<(u64, u64)>, RecordingError> {
    if length < FILE_HEAD + FILE_END {
        return Ok(None);
    }
    file.seek(SeekFrom::Start(length - FILE_END))?;
    let mut end = [0; FILE_END as usize];
    file.read_exact(&mut end)?;
    let [place @ .., _, _, _, _, _, _, _, _] = end;
    let place = u64::from_le_bytes(place);
    // Before the index stands a length of zero.
    let is_possible = end.ends_with(END) && (FILE_HEAD + 4..=length - FILE_END).contains(&place);
    Ok(is_possible.then(|| (place, place - 4)))
}

/// Head and content of what is at `place`, which ends at `end` at the latest.
fn read_at(
    file: &mut (impl Read + Seek),
    place: u64,
    end: u64,
) -> Result<(Head, Vec<u8>), RecordingError> {
    let cut = |_| RecordingError::Damaged("it is cut off");
    file.seek(SeekFrom::Start(place))?;
    let mut head = [0; CHUNK_HEAD as usize];
    file.read_exact(&mut head).map_err(cut)?;
    let [l0, l1, l2, l3, s0, s1, s2, s3, time @ ..] = head;
    let head = Head {
        length: u32::from_le_bytes([l0, l1, l2, l3]),
        sum: u32::from_le_bytes([s0, s1, s2, s3]),
        time: f64::from_le_bytes(time),
    };
    let length = u64::from(head.length);
    if length > MAX_CHUNK || end.saturating_sub(place + CHUNK_HEAD) < length {
        return Err(RecordingError::Damaged("it is cut off"));
    }
    let mut bytes = vec![0; head.length as usize];
    file.read_exact(&mut bytes).map_err(cut)?;
    if crc32fast::hash(&bytes) != head.sum {
        return Err(RecordingError::Damaged("a sum is wrong"));
    }
    Ok((head, chunk::decompress(&bytes, MAX_CHUNK)?))
}

/// The index of a file that has none: of all chunks up to the first that is not whole.
fn scan(file: &mut (impl Read + Seek), length: u64) -> Result<Index, RecordingError> {
    let mut index = Index {
        time_step: 0.05,
        ..Index::default()
    };
    let mut place = FILE_HEAD;
    while let Ok((head, chunk)) = read_at(file, place, length) {
        let Ok(found) = Found::of(&chunk) else { break };
        if head.length == 0 || !head.time.is_finite() {
            break;
        }
        let number = index.chunks.len();
        index.chunks.push(ChunkPlace {
            time: head.time,
            place,
            length: head.length,
        });
        place += CHUNK_HEAD + u64::from(head.length);
        for hash in found.blobs {
            index.blobs.entry(hash).or_insert(number);
        }
        found.marks.into_iter().for_each(|mark| index.mark(mark));
        if number == 0 {
            (index.start, index.name) = (head.time, found.name);
            index.time_step = found.time_step.unwrap_or(index.time_step);
        }
        index.end = found.end;
    }
    Ok(index)
}

/// What an index says about a chunk.
#[derive(Default)]
struct Found {
    name: String,
    time_step: Option<f64>,
    end: f64,
    blobs: Vec<Hash>,
    marks: Vec<Mark>,
}

impl Found {
    fn of(chunk: &[u8]) -> Result<Self, RecordingError> {
        let mut found = Self::default();
        for message in chunk::messages(chunk) {
            let message = message?;
            found.end = message.time;
            match message.content {
                Content::Blob { hash, .. } => found.blobs.push(Hash(hash)),
                Content::Text(text) => found.read_text(text, message.time),
                Content::Binary(_) => {}
            }
        }
        Ok(found)
    }

    /// The name of the scene, and errors in the log.
    fn read_text(&mut self, text: &str, time: f64) {
        let Ok(message) = serde_json::from_str::<BTreeMap<String, Value>>(text) else {
            return;
        };
        if let Some(scene) = message.get("scene").filter(|_| self.name.is_empty()) {
            scene["name"]
                .as_str()
                .unwrap_or_default()
                .clone_into(&mut self.name);
            self.time_step = scene["timeStep"].as_f64();
        }
        let lines = message
            .get("log")
            .and_then(Value::as_array)
            .into_iter()
            .flatten();
        let errors = lines.filter(|line| line["level"] == "scripterrors");
        self.marks.extend(errors.map(|line| Mark {
            time,
            kind: MarkKind::Error,
            text: line["text"].as_str().unwrap_or_default().to_owned(),
            handle: line["handle"].as_i64(),
        }));
    }
}
