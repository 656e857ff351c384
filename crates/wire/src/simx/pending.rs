//! Commands that wait for their execution, and streams, which are executed again and again (spec: legacy-remote-api 3).

use std::collections::BTreeMap;
use std::sync::Arc;

use super::message::{Command, Mode, Piece};
use super::{MAX_COMMANDS, MAX_SIZE, Violation};

/// What distinguishes commands: the number and the key.
type Identity = (u16, Vec<u8>);

/// The commands that wait, in the order of their execution.
#[derive(Default)]
pub(super) struct Pending {
    last: u64,
    entries: BTreeMap<u64, Entry>,
    /// The place of the first command of each identity.
    places: BTreeMap<Identity, u64>,
    /// Bytes of all commands.
    size: usize,
    incomplete: BTreeMap<Identity, Incomplete>,
    /// Bytes of those that are incomplete.
    incomplete_size: usize,
}

struct Entry {
    command: Arc<Command>,
    /// Distinguishes the commands that were at the same place.
    registration: u64,
    /// System time of the last execution of a stream, milliseconds.
    executed: Option<i32>,
}

/// A command of which pieces are missing.
struct Incomplete {
    full: usize,
    data: Vec<u8>,
}

/// A command whose turn it is.
#[derive(Debug, Clone)]
pub(super) struct Job {
    pub place: u64,
    pub registration: u64,
    pub command: Arc<Command>,
}

impl Pending {
    pub(super) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// How many of the commands are streams.
    pub(super) fn streams(&self) -> usize {
        self.entries
            .values()
            .filter(|entry| entry.command.mode.is_stream())
            .count()
    }

    /// Adds a command, or a piece of one; returns whether a command is complete now.
    ///
    /// # Errors
    /// When it belongs to no piece before it, or too much waits.
    pub(super) fn receive(&mut self, piece: Piece) -> Result<bool, Violation> {
        let Piece {
            command,
            offset,
            full,
        } = piece;
        if offset == 0 && command.data.len() == full {
            self.insert(command)?;
            return Ok(true);
        }
        self.put_together(command, offset, full)
    }

    fn put_together(
        &mut self,
        mut command: Command,
        offset: usize,
        full: usize,
    ) -> Result<bool, Violation> {
        let identity = command.identity();
        let mut whole = match self.incomplete.remove(&identity) {
            Some(before) => {
                self.incomplete_size -= before.data.len();
                if before.full == full && offset > 0 {
                    before
                } else {
                    Incomplete {
                        full,
                        data: Vec::new(),
                    }
                }
            }
            None => Incomplete {
                full,
                data: Vec::new(),
            },
        };
        if offset != whole.data.len() {
            return Err(Violation::Malformed);
        }
        whole.data.append(&mut command.data);
        if whole.data.len() == full {
            command.data = whole.data;
            self.insert(command)?;
            return Ok(true);
        }
        self.incomplete_size += whole.data.len();
        self.incomplete.insert(identity, whole);
        if self.incomplete_size > MAX_SIZE {
            return Err(Violation::TooLarge);
        }
        if self.incomplete.len() > MAX_COMMANDS {
            Err(Violation::TooMany)
        } else {
            Ok(false)
        }
    }

    fn insert(&mut self, command: Command) -> Result<(), Violation> {
        let size = size_of(&command);
        let equal = self
            .places
            .get(&command.identity())
            .copied()
            .filter(|_| !command.is_appended);
        match equal.and_then(|place| self.entries.get_mut(&place)) {
            Some(entry)
                if entry.command.mode == Mode::OneshotSplit
                    && command.mode == Mode::OneshotSplit =>
            {
                return Ok(());
            }
            Some(entry) => {
                self.last += 1;
                self.size -= size_of(&entry.command);
                entry.registration = self.last;
                entry.command = Arc::new(command);
            }
            None => self.append(command),
        }
        self.size += size;
        if self.size > MAX_SIZE {
            return Err(Violation::TooLarge);
        }
        if self.entries.len() > MAX_COMMANDS {
            Err(Violation::TooMany)
        } else {
            Ok(())
        }
    }

    fn append(&mut self, command: Command) {
        self.last += 1;
        self.places.entry(command.identity()).or_insert(self.last);
        let entry = Entry {
            command: Arc::new(command),
            registration: self.last,
            executed: None,
        };
        self.entries.insert(self.last, entry);
    }

    /// The commands whose turn it is, in order. What is no stream is gone then. `is_sent` says of a place whether its last result was
    /// sent as a whole; `now` is the system time in milliseconds.
    pub(super) fn take_due(&mut self, now: i32, is_sent: impl Fn(u64) -> bool) -> Vec<Job> {
        let mut jobs = Vec::new();
        for (&place, entry) in &mut self.entries {
            let is_due = match entry.command.mode {
                Mode::Streaming => entry.has_waited(now),
                Mode::StreamingSplit => is_sent(place),
                _ => true,
            };
            if is_due {
                entry.executed = Some(now);
                jobs.push(Job {
                    place,
                    registration: entry.registration,
                    command: entry.command.clone(),
                });
            }
        }
        for job in &jobs {
            if !job.command.mode.is_stream() {
                self.remove(job);
            }
        }
        jobs
    }

    /// Removes the command of a job, unless another one has taken its place.
    pub(super) fn remove(&mut self, job: &Job) {
        let is_there = self
            .entries
            .get(&job.place)
            .is_some_and(|entry| entry.registration == job.registration);
        let Some(entry) = is_there.then(|| self.entries.remove(&job.place)).flatten() else {
            return;
        };
        self.size -= size_of(&entry.command);
        let identity = entry.command.identity();
        if self.places.get(&identity) == Some(&job.place) {
            self.places.remove(&identity);
        }
    }
}

impl Entry {
    fn has_waited(&self, now: i32) -> bool {
        self.executed
            .is_none_or(|before| now.wrapping_sub(before) >= i32::from(self.command.delay))
    }
}

/// Bytes that a command takes, roughly.
fn size_of(command: &Command) -> usize {
    command.key.len() + command.data.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn command(mode: Mode, key: u8, data: &[u8]) -> Command {
        Command {
            id: 0x1001,
            mode,
            key: vec![key, 0, 0, 0],
            data: data.to_vec(),
            delay: 0,
            is_appended: false,
        }
    }

    fn whole(command: Command) -> Piece {
        Piece {
            full: command.data.len(),
            offset: 0,
            command,
        }
    }

    fn names(jobs: &[Job]) -> Vec<(u8, Vec<u8>)> {
        jobs.iter()
            .map(|job| (job.command.key[0], job.command.data.clone()))
            .collect()
    }

    fn due(pending: &mut Pending, now: i32) -> Vec<(u8, Vec<u8>)> {
        names(&pending.take_due(now, |_| true))
    }

    #[test]
    fn equal_commands_take_the_place_of_those_before() {
        let mut pending = Pending::default();
        for (key, data) in [(1, b"a"), (2, b"b"), (1, b"c")] {
            assert_eq!(
                pending.receive(whole(command(Mode::Oneshot, key, data))),
                Ok(true)
            );
        }
        let appended = Command {
            is_appended: true,
            ..command(Mode::Oneshot, 1, b"d")
        };
        pending.receive(whole(appended)).expect("there is room");
        assert_eq!(
            due(&mut pending, 0),
            [(1, b"c".to_vec()), (2, b"b".to_vec()), (1, b"d".to_vec())]
        );
        assert!(pending.is_empty() && pending.places.is_empty() && pending.size == 0);
    }

    #[test]
    fn streams_stay_until_something_else_takes_their_place() {
        let mut pending = Pending::default();
        pending
            .receive(whole(command(Mode::Streaming, 1, b"")))
            .expect("there is room");
        assert_eq!(
            (
                due(&mut pending, 0).len(),
                due(&mut pending, 0).len(),
                pending.streams()
            ),
            (1, 1, 1)
        );
        pending
            .receive(whole(command(Mode::Oneshot, 1, b"")))
            .expect("there is room");
        assert_eq!(
            (due(&mut pending, 0).len(), due(&mut pending, 0).len()),
            (1, 0)
        );
    }

    #[test]
    fn streams_wait_for_their_time() {
        let mut pending = Pending::default();
        let slow = Command {
            delay: 20,
            ..command(Mode::Streaming, 1, b"")
        };
        pending.receive(whole(slow)).expect("there is room");
        let times: Vec<i32> = (0..60)
            .filter(|&now| !due(&mut pending, now).is_empty())
            .collect();
        assert_eq!(times, [0, 20, 40]);
    }

    #[test]
    fn split_streams_wait_until_their_result_is_sent() {
        let mut pending = Pending::default();
        pending
            .receive(whole(command(Mode::StreamingSplit, 1, b"")))
            .expect("there is room");
        assert_eq!(
            (
                pending.take_due(0, |_| false).len(),
                pending.take_due(0, |_| true).len()
            ),
            (0, 1)
        );
    }

    #[test]
    fn pieces_are_put_together() {
        let mut pending = Pending::default();
        let mut piece = |offset, data| {
            pending.receive(Piece {
                command: command(Mode::OneshotSplit, 1, data),
                offset,
                full: 7,
            })
        };
        assert_eq!(piece(0, b"xyz"), Ok(false));
        assert_eq!(
            (piece(0, b"abc"), piece(3, b"def"), piece(6, b"g")),
            (Ok(false), Ok(false), Ok(true))
        );
        assert_eq!(
            piece(3, b"def"),
            Err(Violation::Malformed),
            "the first piece is missing"
        );
        assert_eq!(due(&mut pending, 0), [(1, b"abcdefg".to_vec())]);
        assert_eq!(pending.incomplete_size, 0);
    }

    #[test]
    fn a_command_in_pieces_that_waits_is_not_replaced() {
        let mut pending = Pending::default();
        for data in [b"a", b"b"] {
            pending
                .receive(whole(command(Mode::OneshotSplit, 1, data)))
                .expect("there is room");
        }
        assert_eq!(due(&mut pending, 0), [(1, b"a".to_vec())]);
    }

    #[test]
    fn too_many_commands_are_refused() {
        let mut pending = Pending::default();
        let mut add = || {
            pending.receive(whole(Command {
                is_appended: true,
                ..command(Mode::Oneshot, 1, b"")
            }))
        };
        assert_eq!(
            (0..=MAX_COMMANDS).find_map(|_| add().err()),
            Some(Violation::TooMany)
        );
    }

    #[test]
    fn a_stream_that_was_replaced_is_not_ended_by_the_one_before() {
        let mut pending = Pending::default();
        pending
            .receive(whole(command(Mode::Streaming, 1, b"")))
            .expect("there is room");
        let jobs = pending.take_due(0, |_| true);
        pending
            .receive(whole(command(Mode::Streaming, 1, b"")))
            .expect("there is room");
        pending.remove(&jobs[0]);
        assert_eq!(pending.streams(), 1);
    }
}
