//! Writing a capture: records are collected, and a thread writes them as frames several times a second.
//!
//! The simulator's thread never waits for the disk, unless more than [`MOST`] bytes are waiting. What was collected is lost for at most [`INTERVAL`]
//! when the process is killed.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::frame::{frame, head};
use crate::record::Record;
use crate::value::Recorded;

/// Time between two frames.
const INTERVAL: Duration = Duration::from_millis(50);
/// Bytes that may wait for the disk.
const MOST: usize = 16 << 20;

/// Writes records to a file.
pub(crate) struct Writer {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    waiting: Mutex<Waiting>,
    /// Something has changed in `waiting`.
    change: Condvar,
}

/// Records that are not written yet.
#[derive(Default)]
struct Waiting {
    records: Vec<u8>,
    is_closed: bool,
    /// Why nothing is written any more.
    failure: Option<io::Error>,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Writer {
    /// Makes the file, which begins with that record at once.
    ///
    /// # Errors
    /// When it cannot be made, or there is no thread for it.
    pub(crate) fn create(path: &Path, first: &Record) -> io::Result<Self> {
        let mut file = File::create(path)?;
        let mut records = Vec::new();
        first.write(&mut records);
        file.write_all(&[&head()[..], &frame(&records)?].concat())?;
        let shared = Arc::<Shared>::default();
        let writing = Arc::clone(&shared);
        let thread = std::thread::Builder::new().name("capture".into());
        let thread = thread.spawn(move || write(&writing, file))?;
        Ok(Self {
            shared,
            thread: Some(thread),
        })
    }

    /// Adds what `write` appends, which are whole records.
    pub(crate) fn add(&self, write: impl FnOnce(&mut Vec<u8>)) {
        let mut waiting = self.shared.lock();
        while waiting.records.len() > MOST && waiting.failure.is_none() {
            self.shared.change.notify_all();
            waiting = self
                .shared
                .change
                .wait(waiting)
                .unwrap_or_else(PoisonError::into_inner);
        }
        if waiting.failure.is_none() {
            write(&mut waiting.records);
        }
    }

    /// Writes what is left.
    ///
    /// # Errors
    /// When something could not be written since the file was made.
    pub(crate) fn close(&mut self) -> io::Result<()> {
        self.shared.lock().is_closed = true;
        self.shared.change.notify_all();
        if let Some(thread) = self.thread.take() {
            // It does not panic.
            let _ = thread.join();
        }
        self.shared.lock().failure.take().map_or(Ok(()), Err)
    }
}

impl Drop for Writer {
    fn drop(&mut self) {
        // Whoever wants to know has closed it.
        let _ = self.close();
    }
}

/// Writes frames until it is closed and nothing is left.
fn write(shared: &Shared, mut file: File) {
    loop {
        let waiting = shared.lock();
        let waited = shared
            .change
            .wait_timeout_while(waiting, INTERVAL, |waiting| {
                !waiting.is_closed && waiting.records.len() <= MOST
            });
        let mut waiting = waited.unwrap_or_else(PoisonError::into_inner).0;
        let (records, is_last) = (std::mem::take(&mut waiting.records), waiting.is_closed);
        drop(waiting);
        if !records.is_empty() {
            let written = frame(&records).and_then(|frame| file.write_all(&frame));
            let mut waiting = shared.lock();
            waiting.failure = waiting.failure.take().or(written.err());
            if waiting.records.capacity() == 0 {
                // The memory of this frame serves the next one.
                waiting.records = records;
                waiting.records.clear();
            }
        }
        shared.change.notify_all();
        if is_last {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reader::Reader;
    use crate::record::Header;

    fn header() -> Record {
        Record::Header(Header::default())
    }

    #[test]
    fn what_was_added_is_in_the_file_before_it_is_closed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.swc");
        let writer = Writer::create(&path, &header()).unwrap();
        writer.add(|out| Record::Turn.write(out));
        let is_there = || {
            Reader::open(&path)
                .is_ok_and(|mut reader| matches!(reader.next_record(), Ok(Some(Record::Turn))))
        };
        let pause = |_: &i32| {
            let (nobody, never) = (Mutex::new(()), Condvar::new());
            let waiting = nobody.lock().unwrap();
            drop(never.wait_timeout(waiting, INTERVAL).unwrap());
        };
        let tries = (0..1000).take_while(|_| !is_there()).inspect(pause);
        assert!(tries.count() < 1000, "written although nobody closes it");
    }

    #[test]
    fn more_than_may_wait_waits_for_the_disk() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.swc");
        let mut writer = Writer::create(&path, &header()).unwrap();
        for _ in 0..40 {
            writer.add(|out| {
                Record::Content {
                    piece: vec![1; 1 << 20],
                    is_last: true,
                }
                .write(out);
            });
            assert!(writer.shared.lock().records.len() <= MOST + (1 << 20) + 8);
        }
        writer.close().unwrap();
        let mut reader = Reader::open(&path).unwrap();
        let mut count = 0;
        while reader.next_record().unwrap().is_some() {
            count += 1;
        }
        assert_eq!(count, 40);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_full_disk_is_said_at_the_end() {
        let mut writer = Writer::create(Path::new("/dev/null"), &header()).unwrap();
        writer.shared.lock().failure = Some(io::Error::other("full"));
        writer.add(|out| Record::Turn.write(out));
        assert_eq!(writer.close().unwrap_err().to_string(), "full");
    }
}
