//! What a tape does with the next thing that happens: writes it, or compares it with what the capture has.

use std::collections::HashMap;
use std::io;
use std::path::Path;
use std::sync::Arc;

use heap::{Outer, outside};

use crate::reader::{Bookmark, CaptureError, Reader};
use crate::record::{Header, PIECE, Record};
use crate::tape::Verdict;
use crate::value::{Input, Recorded, write_number};
use crate::writer::Writer;

/// A capture that is being written.
pub(crate) struct Capturing {
    writer: Writer,
    kinds: HashMap<String, u64>,
    /// The numbers of contents by their SHA-256.
    contents: HashMap<Vec<u8>, u64>,
    pub(crate) steps: u64,
    /// The bytes of the value that is being written.
    value: Vec<u8>,
}

impl Capturing {
    pub(crate) fn create(path: &Path, header: &Header) -> io::Result<Self> {
        let writer = Writer::create(path, &Record::Header(header.clone()))?;
        Ok(Self {
            writer,
            kinds: HashMap::new(),
            contents: HashMap::new(),
            steps: 0,
            value: Vec::new(),
        })
    }

    pub(crate) fn add(&self, record: &Record) {
        self.writer.add(|out| record.write(out));
    }

    pub(crate) fn add_input(&mut self, kind: &str, value: &impl Recorded) {
        let kind = self.number_of(kind);
        self.value.clear();
        value.write(&mut self.value);
        let value = &self.value;
        self.writer.add(|out| Record::write_input(kind, value, out));
    }

    fn number_of(&mut self, kind: &str) -> u64 {
        if let Some(&number) = self.kinds.get(kind) {
            return number;
        }
        let number = self.kinds.len() as u64;
        self.kinds.insert(kind.to_owned(), number);
        self.add(&Record::Kind(kind.to_owned()));
        number
    }

    /// The number of a content, which is written when it is the first of its bytes.
    pub(crate) fn number_of_content(&mut self, content: &[u8]) -> u64 {
        let hash = ring::digest::digest(&ring::digest::SHA256, content);
        let next = self.contents.len() as u64;
        let number = *self.contents.entry(hash.as_ref().to_vec()).or_insert(next);
        if number == next {
            self.add_content(content);
        }
        number
    }

    fn add_content(&self, content: &[u8]) {
        let (last, others) = match content.chunks(PIECE).collect::<Vec<_>>().split_last() {
            Some((last, others)) => (*last, others.to_vec()),
            None => (&[][..], Vec::new()),
        };
        let pieces = others.into_iter().map(|piece| (piece, false));
        for (piece, is_last) in pieces.chain([(last, true)]) {
            let piece = piece.to_vec();
            self.add(&Record::Content { piece, is_last });
        }
    }

    pub(crate) fn close(&mut self) -> io::Result<()> {
        self.add(&Record::End);
        self.writer.close()
    }
}

/// A capture that is being replayed.
pub(crate) struct Replaying {
    reader: Reader,
    /// The next thing that happened, if it was looked at.
    next: Option<Record>,
    kinds: Vec<String>,
    contents: Vec<Arc<Vec<u8>>>,
    /// How many of them were read up to the present place.
    kinds_read: usize,
    contents_read: usize,
    /// The pieces of a content that is not complete.
    pieces: Vec<u8>,
    pub(crate) steps: u64,
    pub(crate) tolerates_hashes: bool,
    /// How the replay has ended; None while it goes on.
    pub(crate) verdict: Option<Verdict>,
}

/// A moment of a replay, to come back to.
#[derive(Debug, Clone)]
pub struct Mark {
    bookmark: Bookmark,
    next: Option<Record>,
    kinds: usize,
    contents: usize,
    pieces: Vec<u8>,
    steps: u64,
}

impl Replaying {
    pub(crate) fn mark(&self) -> Mark {
        Mark {
            bookmark: self.reader.bookmark(),
            next: self.next.clone(),
            kinds: self.kinds_read,
            contents: self.contents_read,
            pieces: self.pieces.clone(),
            steps: self.steps,
        }
    }

    /// Goes back to a moment, or forward to one that was reached before.
    pub(crate) fn go_to(&mut self, mark: &Mark) -> io::Result<()> {
        self.reader.go_to(&mark.bookmark)?;
        self.next.clone_from(&mark.next);
        // What came later comes again, with the same numbers.
        self.kinds_read = mark.kinds;
        self.contents_read = mark.contents;
        self.pieces.clone_from(&mark.pieces);
        self.steps = mark.steps;
        self.verdict = None;
        Ok(())
    }

    pub(crate) fn new(reader: Reader) -> Self {
        Self {
            reader,
            next: None,
            kinds: Vec::new(),
            contents: Vec::new(),
            kinds_read: 0,
            contents_read: 0,
            pieces: Vec::new(),
            steps: 0,
            tolerates_hashes: false,
            verdict: None,
        }
    }

    /// The value of the next input, which must be of that kind. `who` asks for it.
    pub(crate) fn take<T: Recorded>(&mut self, kind: &str, who: &dyn Fn() -> String) -> Option<T> {
        let value = match self.take_next()? {
            Record::Input { kind: found, value } if self.is(found, kind) => Outer::new(value),
            other => {
                let found = self.described(&other);
                self.differs(format!(
                    "{} asks for {kind}, where the capture has {found}",
                    named(who())
                ));
                outside(|| drop(other));
                return None;
            }
        };
        // The value is made where the one who asks is.
        let mut input = Input::new(value.get());
        let read = T::read(&mut input).filter(|_| input.is_empty());
        if read.is_none() {
            self.differs(format!("the value of {kind} in the capture is none"));
        }
        read
    }

    /// The same, only if the next record is one of that kind and key.
    pub(crate) fn take_if<T: Recorded>(&mut self, kind: &str, key: u64) -> Option<T> {
        let expected = {
            let mut bytes = Vec::new();
            write_number(key, &mut bytes);
            bytes
        };
        let is_it = match self.peek()? {
            Record::Input { kind: found, value } => {
                let (found, has_key) = (*found, value.starts_with(&expected));
                has_key && self.is(found, kind)
            }
            _ => false,
        };
        if !is_it {
            return None;
        }
        self.take::<(u64, T)>(kind, &String::new)
            .map(|(_, value)| value)
    }

    /// Whether the next record is an input of that kind.
    pub(crate) fn next_is(&mut self, kind: &str) -> bool {
        match self.peek() {
            Some(&Record::Input { kind: found, .. }) => self.is(found, kind),
            _ => false,
        }
    }

    /// The content with that number.
    pub(crate) fn content(&mut self, number: u64) -> Option<Vec<u8>> {
        let content = self.contents.get(usize::try_from(number).ok()?);
        let content = content.map(|content| content.to_vec());
        if content.is_none() {
            self.differs(format!("the capture has no content {number}"));
        }
        content
    }

    pub(crate) fn turn(&mut self) -> Option<()> {
        match self.take_next()? {
            Record::Turn => Some(()),
            other => {
                let found = self.described(&other);
                self.differs(format!(
                    "an iteration of the loop begins, where the capture has {found}"
                ));
                None
            }
        }
    }

    pub(crate) fn step(&mut self, hash: u64) -> Option<()> {
        match self.take_next()? {
            Record::Step { hash: captured, .. } if captured == hash || self.tolerates_hashes => {
                self.steps += 1;
                return Some(());
            }
            Record::Step { hash: captured, .. } => self.differs(format!(
                "the state has the hash {hash:016x}, where the capture has {captured:016x}"
            )),
            other => {
                let found = self.described(&other);
                self.differs(format!("a step ends, where the capture has {found}"));
            }
        }
        None
    }

    /// The run has ended: so does the capture, or not.
    pub(crate) fn end(&mut self) {
        match self.take_next() {
            Some(Record::End) => self.verdict = Some(Verdict::Same { steps: self.steps }),
            Some(other) => {
                let found = self.described(&other);
                self.differs(format!("the run has ended, where the capture has {found}"));
            }
            None => {}
        }
    }

    fn is(&self, number: u64, kind: &str) -> bool {
        let known = usize::try_from(number).ok();
        known
            .and_then(|place| self.kinds.get(place))
            .is_some_and(|known| known == kind)
    }

    fn described(&self, record: &Record) -> String {
        match record {
            Record::Input { kind, .. } => {
                let name = usize::try_from(*kind)
                    .ok()
                    .and_then(|place| self.kinds.get(place));
                name.map_or_else(|| format!("an input {kind}"), Clone::clone)
            }
            Record::Turn => "the next iteration of the loop".into(),
            Record::Step { .. } => "the end of a step".into(),
            Record::End => "the end of the run".into(),
            _ => "something else".into(),
        }
    }

    pub(crate) fn differs(&mut self, what: String) {
        let step = self.steps + 1;
        outside(|| {
            let what = what.clone();
            self.verdict.get_or_insert(Verdict::Differs { step, what });
        });
    }

    fn take_next(&mut self) -> Option<Record> {
        self.peek()?;
        self.next.take()
    }

    /// The next thing that happened. None where the capture ends, or after the run has differed.
    fn peek(&mut self) -> Option<&Record> {
        if self.verdict.is_some() {
            return None;
        }
        outside(|| self.read_on());
        self.next.as_ref()
    }

    /// Reads until the next thing that happened, or the end.
    fn read_on(&mut self) {
        while self.next.is_none() {
            match self.reader.next_record() {
                Ok(Some(record)) => self.sort(record),
                Ok(None) => {
                    self.verdict = Some(Verdict::Cut { steps: self.steps });
                    return;
                }
                Err(error) => {
                    self.verdict = Some(Verdict::Unreadable(error.to_string()));
                    return;
                }
            }
        }
    }

    /// Keeps what others refer to; what happened is the next thing.
    fn sort(&mut self, record: Record) {
        match record {
            Record::Kind(name) => {
                if self.kinds_read == self.kinds.len() {
                    self.kinds.push(name);
                }
                self.kinds_read += 1;
            }
            Record::Content { piece, is_last } => {
                self.pieces.extend(piece);
                if is_last {
                    let content = std::mem::take(&mut self.pieces);
                    if self.contents_read == self.contents.len() {
                        self.contents.push(Arc::new(content));
                    }
                    self.contents_read += 1;
                }
            }
            // The reader has it; and what a capture lacks is for those who read about it.
            Record::Header(_) | Record::Lacks(_) => {}
            other => self.next = Some(other),
        }
    }
}

/// Who asks, in a sentence.
fn named(who: String) -> String {
    if who.is_empty() {
        "the simulator".into()
    } else {
        who
    }
}

impl From<CaptureError> for io::Error {
    fn from(error: CaptureError) -> Self {
        match error {
            CaptureError::Io(error) => error,
            other => Self::new(io::ErrorKind::InvalidData, other.to_string()),
        }
    }
}
