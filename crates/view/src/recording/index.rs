//! The index of a recording: where its chunks are, which blobs they hold, and what happened when.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::{CHUNK_HEAD, FILE_HEAD, RecordingError};
use crate::blobs::Hash;

/// Marks that are kept of each kind: nobody looks at more, and a script may fail at every step.
const MAX_MARKS: usize = 10_000;

/// Where a chunk is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChunkPlace {
    /// Of its first message, seconds.
    pub time: f64,
    /// Of its head, from the beginning of the file.
    pub place: u64,
    /// Of the compressed bytes.
    pub length: u32,
}

/// Something that happened, to be found on the timeline.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Seconds.
    pub time: f64,
    /// What happened.
    pub kind: MarkKind,
    /// What is shown of it.
    pub text: String,
    /// Of the object it is about.
    pub handle: Option<i64>,
}

/// What a mark stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MarkKind {
    /// An error of a script.
    Error,
    /// A signal was set or cleared.
    Signal,
    /// A script sent a message to all others.
    Broadcast,
    /// Two objects touched.
    Contact,
    /// Of a test.
    Failure,
}

impl MarkKind {
    const ALL: [Self; 5] = [
        Self::Error,
        Self::Signal,
        Self::Broadcast,
        Self::Contact,
        Self::Failure,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Signal => "signal",
            Self::Broadcast => "broadcast",
            Self::Contact => "contact",
            Self::Failure => "failure",
        }
    }
}

/// What a recording contains.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Index {
    /// Of the scene.
    pub name: String,
    /// Times of the first and the last message, seconds.
    pub start: f64,
    /// Time of the last message, seconds.
    pub end: f64,
    /// Seconds.
    pub time_step: f64,
    /// The chunks, in the order of time.
    pub chunks: Vec<ChunkPlace>,
    /// In which chunk each blob is.
    pub blobs: BTreeMap<Hash, usize>,
    /// What happened, in the order of time.
    pub marks: Vec<Mark>,
}

impl Index {
    /// Adds a mark, unless there are very many of its kind.
    pub(crate) fn mark(&mut self, mark: Mark) {
        if self
            .marks
            .iter()
            .filter(|other| other.kind == mark.kind)
            .count()
            < MAX_MARKS
        {
            self.marks.push(mark);
        }
    }

    /// JSON; `blob` writes where a blob is, from its hash and the number of its chunk.
    pub(crate) fn json(&self, blob: impl Fn(Hash, usize) -> Value) -> Value {
        let place = |chunk: &ChunkPlace| json!({ "time": chunk.time, "place": chunk.place, "length": chunk.length });
        let mark = |mark: &Mark| {
            let mut value =
                json!({ "time": mark.time, "kind": mark.kind.name(), "text": mark.text });
            if let Some(handle) = mark.handle {
                value["handle"] = handle.into();
            }
            value
        };
        let blobs = self
            .blobs
            .iter()
            .map(|(hash, chunk)| (hash.to_string(), blob(*hash, *chunk)));
        json!({
            "version": super::VERSION,
            "name": self.name,
            "start": self.start,
            "end": self.end,
            "timeStep": self.time_step,
            "chunks": self.chunks.iter().map(place).collect::<Vec<_>>(),
            "blobs": blobs.collect::<serde_json::Map<_, _>>(),
            "marks": self.marks.iter().map(mark).collect::<Vec<_>>(),
        })
    }

    /// The same as in the file.
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        self.json(|_, chunk| chunk.into()).to_string().into_bytes()
    }

    /// The index of a file whose chunks end at `end`. Nothing is trusted: places lie in the file, one after the other.
    pub(super) fn from_bytes(bytes: &[u8], end: u64) -> Result<Self, RecordingError> {
        let value: Value = serde_json::from_slice(bytes)
            .map_err(|_| RecordingError::Damaged("its index is no JSON"))?;
        Self::from_json(&value, end).ok_or(RecordingError::Damaged("its index is wrong"))
    }

    fn from_json(value: &Value, end: u64) -> Option<Self> {
        let chunks: Vec<ChunkPlace> = value["chunks"]
            .as_array()?
            .iter()
            .map(chunk_place)
            .collect::<Option<_>>()?;
        let mut next = FILE_HEAD;
        for chunk in &chunks {
            if chunk.place < next || end - CHUNK_HEAD < u64::from(chunk.length) {
                return None;
            }
            next = chunk
                .place
                .checked_add(CHUNK_HEAD + u64::from(chunk.length))
                .filter(|next| *next <= end)?;
        }
        let blob = |(hash, chunk): (&String, &Value)| {
            let chunk = usize::try_from(chunk.as_u64()?)
                .ok()
                .filter(|chunk| *chunk < chunks.len())?;
            Some((Hash::from_text(hash)?, chunk))
        };
        Some(Self {
            name: value["name"].as_str()?.to_owned(),
            start: value["start"].as_f64()?,
            end: value["end"].as_f64()?,
            time_step: value["timeStep"].as_f64()?,
            blobs: value["blobs"]
                .as_object()?
                .iter()
                .map(blob)
                .collect::<Option<_>>()?,
            marks: value["marks"]
                .as_array()?
                .iter()
                .map(mark)
                .collect::<Option<_>>()?,
            chunks,
        })
    }
}

fn chunk_place(value: &Value) -> Option<ChunkPlace> {
    let length = value["length"].as_u64()?.try_into().ok()?;
    Some(ChunkPlace {
        time: value["time"].as_f64()?,
        place: value["place"].as_u64()?,
        length,
    })
}

fn mark(value: &Value) -> Option<Mark> {
    let kind = value["kind"].as_str()?;
    Some(Mark {
        time: value["time"].as_f64()?,
        kind: MarkKind::ALL
            .into_iter()
            .find(|known| known.name() == kind)?,
        text: value["text"].as_str()?.to_owned(),
        handle: value["handle"].as_i64(),
    })
}
