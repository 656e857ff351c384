//! What a server knows of its client: commands that wait, and results that wait to be fetched (spec: legacy-remote-api 2).

use std::collections::VecDeque;

use super::bytes::{ByteOrder, FieldWriter};
use super::message::{self, Command, Mode, ReplyHead, ReplyPiece, Stamp};
use super::pending::{Job, Pending};
use super::splits::{Split, size_of_piece};
use super::{MAX_SIZE, Violation};

/// Ends the connection.
const KILL_CONNECTION: u16 = 0x000a;

/// Lines for the monitor that are kept.
const MAX_LINES: usize = 1000;

/// The state of one server, of which one client is served at a time.
#[derive(Default)]
pub struct Session {
    /// Where the client is; None without one.
    peer: Option<String>,
    /// How many clients there were.
    connections: u64,
    client: Client,
    head: ReplyHead,
    traffic: Traffic,
    /// What happens, for people; None where nobody wants to know.
    monitor: Option<VecDeque<String>>,
}

/// What ends with the connection.
#[derive(Default)]
struct Client {
    order: ByteOrder,
    has_checksum: bool,
    version: Option<u8>,
    /// Id and time of the last message.
    last: Option<(i32, i32)>,
    /// Whether its commands have not been executed yet.
    is_waiting: bool,
    /// Whether a batch is being executed.
    is_executing: bool,
    pending: Pending,
    splits: Vec<Split>,
    /// Results as bytes.
    outbox: Vec<u8>,
    results: usize,
}

impl Default for ReplyHead {
    fn default() -> Self {
        Self {
            id: -1,
            client_time: 0,
            stamp: Stamp::default(),
        }
    }
}

/// What `simRemoteApi.status` reports, times in milliseconds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Traffic {
    /// When the last message arrived.
    pub last_request: i64,
    /// When the last reply was made.
    pub last_reply: i64,
    /// Time between the last two messages.
    pub between_requests: i64,
    /// Commands in the last message.
    pub commands_in_request: usize,
    /// Results in the last reply.
    pub commands_in_reply: usize,
}

/// What a message asks the server to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Received {
    /// Commands wait that can be executed now.
    pub is_waiting: bool,
    /// The connection ends after the reply.
    pub ends: bool,
}

/// Commands to be executed, and their results so far.
pub struct CommandBatch {
    connection: u64,
    /// Of the reply that fetches the results.
    head: ReplyHead,
    /// The byte order of the client.
    pub order: ByteOrder,
    jobs: VecDeque<Job>,
    answers: Vec<(Job, Answer)>,
    size: usize,
}

/// The result of a command.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Answer {
    /// The command was not executed, or failed.
    pub failed: bool,
    /// What the command returns, in the byte order of the client.
    pub data: Vec<u8>,
    /// A stream is over.
    pub ends_stream: bool,
}

impl Answer {
    /// The result of a command that failed: no data.
    pub fn failure() -> Self {
        Self {
            failed: true,
            ..Self::default()
        }
    }
}

impl CommandBatch {
    /// The next command that is to be executed. Discontinued streams need no execution.
    pub fn next(&mut self) -> Option<std::sync::Arc<Command>> {
        while let Some(job) = self.jobs.front() {
            if job.command.mode != Mode::Discontinue {
                return Some(job.command.clone());
            }
            self.answer(Answer::default());
        }
        None
    }

    /// Whether the results are as many as a reply can have.
    pub fn is_full(&self) -> bool {
        self.size > MAX_SIZE / 4
    }

    /// The result of that command.
    pub fn answer(&mut self, answer: Answer) {
        if let Some(job) = self.jobs.pop_front() {
            self.size += answer.data.len();
            self.answers.push((job, answer));
        }
    }
}

impl Session {
    /// A server without a client; `is_monitored` keeps lines about what happens, see [`take_lines`](Self::take_lines).
    pub fn new(is_monitored: bool) -> Self {
        Self {
            monitor: is_monitored.then(VecDeque::new),
            ..Self::default()
        }
    }

    /// A client has come.
    pub fn connect(&mut self, peer: String) {
        self.note(|| "connecting to client...".into());
        self.connections += 1;
        self.peer = Some(peer);
        self.client = Client::default();
        self.head = ReplyHead {
            stamp: self.head.stamp,
            ..ReplyHead::default()
        };
        self.note(|| "connected to client.".into());
    }

    /// The client is gone, and with it what it wanted.
    pub fn disconnect(&mut self) {
        self.peer = None;
        self.client = Client::default();
        self.note(|| "disconnected from client.".into());
    }

    /// The number of the connection; None without a client.
    pub fn connection(&self) -> Option<u64> {
        self.peer.as_ref().map(|_| self.connections)
    }

    /// The address of the client; None without one.
    pub fn peer(&self) -> Option<&str> {
        self.peer.as_deref()
    }

    /// The protocol version of the client; None until its first message.
    pub fn client_version(&self) -> Option<u8> {
        self.client.version
    }

    /// Times and counts of the last messages.
    pub fn traffic(&self) -> Traffic {
        self.traffic
    }

    /// What has happened since the last time.
    pub fn take_lines(&mut self) -> Vec<String> {
        self.monitor
            .as_mut()
            .map(|lines| lines.drain(..).collect())
            .unwrap_or_default()
    }

    fn note(&mut self, line: impl FnOnce() -> String) {
        if let Some(lines) = &mut self.monitor {
            if lines.len() >= MAX_LINES {
                lines.pop_front();
            }
            lines.push_back(line());
        }
    }

    /// Whether there is something to execute, and room for its results.
    pub fn is_ready(&self) -> bool {
        self.client.outbox.is_empty() && !self.client.pending.is_empty()
    }

    /// Whether the commands of the last message have not been executed yet, though they could be.
    pub fn is_waiting(&self) -> bool {
        self.client.is_executing || self.client.is_waiting && self.is_ready()
    }

    /// Takes a message of the client; `now` is in milliseconds.
    ///
    /// # Errors
    /// When the connection is to be closed.
    pub fn receive(
        &mut self,
        message: &[u8],
        order: ByteOrder,
        now: i64,
    ) -> Result<Received, Violation> {
        let (head, pieces) = message::parse(message, order)?;
        let traffic = &mut self.traffic;
        traffic.between_requests = now
            - if traffic.last_request == 0 {
                now
            } else {
                traffic.last_request
            };
        (traffic.last_request, traffic.commands_in_request) = (now, pieces.len());
        self.note(|| {
            format!(
                "data received: {} bytes (message ID = {})",
                message.len(),
                head.id
            )
        });
        let client = &mut self.client;
        (client.order, client.has_checksum) = (order, head.has_checksum);
        (client.version, client.last) = (Some(head.version), Some((head.id, head.time)));
        let mut ends = false;
        for piece in pieces {
            if piece.command.id == KILL_CONNECTION {
                ends = true;
            } else if client.pending.receive(piece)? {
                client.is_waiting = true;
            }
        }
        Ok(Received {
            is_waiting: self.is_waiting(),
            ends,
        })
    }

    /// The reply to the message that was received, which fetches the results; `now` is in milliseconds.
    pub fn reply(&mut self, now: i64) -> Vec<u8> {
        let client = &mut self.client;
        let mut writer = FieldWriter::new(client.order);
        writer.bytes(&client.outbox);
        client
            .splits
            .retain_mut(|split| !split.write_next(&mut writer));
        let reply = message::reply(
            self.head,
            &writer.into_bytes(),
            client.has_checksum,
            client.order,
        );
        client.outbox = Vec::new();
        let results = std::mem::take(&mut client.results);
        (self.traffic.last_reply, self.traffic.commands_in_reply) = (now, results);
        let (id, streams) = (self.head.id, client.pending.streams());
        let size = reply.len();
        self.note(|| {
            format!("reply sent: {size} bytes (message ID = {id}, stream cmd cnt = {streams})")
        });
        self.head.id = -1;
        reply
    }

    /// The commands to be executed now. None before the last results are fetched, and when there are none.
    pub fn due(&mut self, stamp: Stamp) -> Option<CommandBatch> {
        let client = &mut self.client;
        if !client.outbox.is_empty() {
            return None;
        }
        let (id, client_time) = client.last?;
        let head = ReplyHead {
            id,
            client_time,
            stamp,
        };
        client.is_waiting = false;
        let is_sent = |place| client.splits.iter().all(|split| split.place != place);
        let jobs = client.pending.take_due(stamp.system_time, is_sent);
        let (connection, order) = (self.connections, client.order);
        if jobs.is_empty() {
            self.head = head;
            return None;
        }
        client.is_executing = true;
        Some(CommandBatch {
            connection,
            head,
            order,
            jobs: jobs.into(),
            answers: Vec::new(),
            size: 0,
        })
    }

    /// Takes the results of commands. Those of a client that is gone are dropped.
    pub fn complete(&mut self, batch: CommandBatch) {
        if self.connection() != Some(batch.connection) {
            return;
        }
        self.client.is_executing = false;
        // Not before: a reply in between would carry the id without the results, and the client would wait for ever.
        self.head = batch.head;
        let mut writer = FieldWriter::new(batch.order);
        for (job, answer) in batch.answers {
            if answer.ends_stream {
                self.client.pending.remove(&job);
            }
            if job.command.mode == Mode::Discontinue {
                let identity = job.command.identity();
                self.client
                    .splits
                    .retain(|split| split.command.identity() != identity);
            }
            self.client
                .add_result(job, answer, batch.head.stamp.simulation_time, &mut writer);
        }
        self.client.outbox = writer.into_bytes();
    }
}

impl Client {
    fn add_result(&mut self, job: Job, answer: Answer, time: i32, writer: &mut FieldWriter) {
        let Answer { failed, data, .. } = answer;
        let command = job.command;
        let in_pieces = match command.mode {
            Mode::OneshotSplit if data.is_empty() => return,
            Mode::OneshotSplit | Mode::StreamingSplit => data.len() > size_of_piece(&command),
            _ => false,
        };
        self.results += 1;
        if in_pieces {
            self.splits.push(Split {
                place: job.place,
                command,
                failed,
                time,
                data,
                sent: 0,
            });
        } else {
            ReplyPiece {
                command: &command,
                failed,
                time,
                offset: 0,
                full: data.len(),
                data: &data,
            }
            .write(writer);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Message 5 with one blocking command, which reads a handle by the name `a`.
    fn message() -> Vec<u8> {
        let size = 28_i32.to_le_bytes();
        let head = [&[0, 0, 11][..], &5_i32.to_le_bytes(), &[0; 11]].concat();
        let mode = (1 << 16 | 0x3001_i32).to_le_bytes();
        [
            &head[..],
            &size,
            &size,
            &2_i16.to_le_bytes(),
            &[0; 4],
            &mode,
            &[0; 8],
            b"a\0",
        ]
        .concat()
    }

    fn id(reply: &[u8]) -> i32 {
        i32::from_le_bytes(reply[3..7].try_into().expect("four bytes"))
    }

    #[test]
    fn the_id_of_a_message_comes_with_its_results() {
        let mut session = Session::new(false);
        session.connect("127.0.0.1".into());
        let received = session
            .receive(&message(), ByteOrder::default(), 0)
            .expect("it is a message");
        assert!(received.is_waiting);
        let mut batch = session.due(Stamp::default()).expect("a command is due");
        assert!(session.is_waiting(), "it is being executed");
        assert_eq!(id(&session.reply(0)), -1);
        batch.answer(Answer {
            data: vec![1, 2, 3, 4],
            ..Answer::default()
        });
        session.complete(batch);
        assert!(!session.is_waiting());
        assert_eq!(id(&session.reply(0)), 5);
        assert_eq!(id(&session.reply(0)), -1);
    }
}
