//! Writers and readers of the node. They end when they are dropped.

use std::rc::Rc;
use std::sync::Arc;

use capture::{Input, Recorded};
use ros_interfaces::{Layout, Record, cdr};
use rtps::{Core, Correlation, EntityId, Guid, Qos, Sample, SampleIdentity, Timestamp, Written};

use super::names;
use super::node::Running;
use script::wall_clock;

/// A writer or reader.
pub(super) struct Endpoint {
    pub(super) node: Rc<Running>,
    pub(super) entity: EntityId,
    /// As DDS calls it.
    pub(super) topic: String,
}

impl Drop for Endpoint {
    fn drop(&mut self) {
        self.node.core(|core| core.remove(self.entity));
    }
}

impl Endpoint {
    pub(super) fn writer(node: &Rc<Running>, topic: &str, layout: &Layout, qos: Qos) -> Self {
        let type_name = names::type_name(&layout.name);
        let entity =
            node.core(|core| core.create_writer(topic, &type_name, qos, &user_data(layout)));
        Self {
            node: node.clone(),
            entity: entity.unwrap_or_default(),
            topic: topic.to_owned(),
        }
    }

    pub(super) fn reader(node: &Rc<Running>, topic: &str, layout: &Layout, qos: Qos) -> Self {
        let type_name = names::type_name(&layout.name);
        let entity =
            node.core(|core| core.create_reader(topic, &type_name, qos, &user_data(layout)));
        Self {
            node: node.clone(),
            entity: entity.unwrap_or_default(),
            topic: topic.to_owned(),
        }
    }

    pub(super) fn take(&self) -> Option<Arrived> {
        let take = || {
            let sample = self.node.core(|core| core.take(self.entity));
            sample.flatten().map(Arrived::from)
        };
        self.node.tape.input("a message of ROS 2", take).ok()?
    }

    pub(super) fn waiting(&self) -> usize {
        let waiting = || self.node.core(|core| core.waiting(self.entity));
        let count = || waiting().unwrap_or_default();
        let count = self
            .node
            .tape
            .input("how many messages of ROS 2 wait", count);
        count.unwrap_or_default()
    }

    /// Whether a message waits of which the newest `is_wanted`. Not on the tape.
    pub(super) fn has_newest(&self, is_wanted: impl FnOnce(&[u8]) -> bool) -> bool {
        let newest = |core: &mut Core| core.newest(self.entity).is_some_and(is_wanted);
        self.node.core(newest).unwrap_or_default()
    }

    /// Whether anything reads what this one writes.
    pub(super) fn has_reader(&self) -> bool {
        let tape = &self.node.tape;
        let answer = tape.input("whether a topic of ROS 2 is read", || self.matched() > 0);
        answer.unwrap_or_default()
    }

    /// Whether one participant elsewhere reads what this one writes, and writes what `reader` reads. Not on the tape.
    pub(super) fn has_partner(&self, reader: &Self) -> bool {
        let (writer, reader) = (self.entity, reader.entity);
        let has_partner = self.node.core(|core| core.has_partner(writer, reader));
        has_partner.unwrap_or_default()
    }

    /// The next message that waits. Not on the tape.
    pub(super) fn take_untaped(&self) -> Option<Vec<u8>> {
        let sample = self.node.core(|core| core.take(self.entity)).flatten();
        sample.map(|sample| sample.payload)
    }

    /// Whether one of these writers elsewhere writes what this one reads. Not on the tape.
    pub(super) fn reads_any(&self, writers: &[[u8; 16]]) -> bool {
        let reads = self.node.core(|core| core.reads_any(self.entity, writers));
        reads.unwrap_or_default()
    }

    /// Whether a participant elsewhere will answer: it reads what this one writes, and what it writes reaches `reader`. Not on the tape.
    pub(super) fn has_responder(&self, reader: &Self) -> bool {
        let (writer, reader) = (self.entity, reader.entity);
        let has_responder = self.node.core(|core| core.has_responder(writer, reader));
        has_responder.unwrap_or_default()
    }

    /// How many readers, here and elsewhere, a writer has. Not on the tape.
    pub(super) fn matched(&self) -> usize {
        let matched = self.node.core(|core| core.matched(self.entity));
        matched.unwrap_or_default()
    }

    pub(super) fn publish(&self, record: &Record) {
        self.write(record, None);
    }

    pub(super) fn write(&self, record: &Record, call: Option<Correlation>) {
        let written = Written {
            payload: cdr::encode(record).into(),
            call,
            time: now(),
        };
        self.node.core(|core| core.write(self.entity, &written));
    }

    /// Writes a request whose answer comes to `replies`. Returns its number.
    pub(super) fn request(&self, record: &Record, replies: &Self, client: u64) -> i64 {
        let payload: Arc<[u8]> = cdr::encode(record).into();
        let send = |core: &mut Core| {
            let sequence = core.next_sequence(self.entity);
            let related = SampleIdentity {
                guid: core.guid(replies.entity),
                sequence,
            };
            let call = Some(Correlation {
                related,
                header: (client, sequence),
            });
            core.write(
                self.entity,
                &Written {
                    payload,
                    call,
                    time: now(),
                },
            );
            sequence
        };
        let send = || self.node.core(send).unwrap_or_default();
        let sent = self
            .node
            .tape
            .input("the number of a request of ROS 2", send);
        sent.unwrap_or_default()
    }

    pub(super) fn guid(&self) -> Guid {
        let guid = || {
            let guid = self.node.core(|core| core.guid(self.entity));
            guid.unwrap_or_default().to_bytes().to_vec()
        };
        let guid = self.node.tape.input("an identity of ROS 2", guid);
        let bytes = guid.ok().and_then(|bytes| bytes.try_into().ok());
        bytes.map(Guid::from_bytes).unwrap_or_default()
    }
}

/// What nodes of Iron and later say of their readers and writers.
fn user_data(layout: &Layout) -> Vec<u8> {
    format!("typehash={};", ros_interfaces::type_hash(layout)).into_bytes()
}

/// A message that has arrived.
pub(super) struct Arrived {
    writer: Guid,
    sequence: i64,
    pub(super) payload: Vec<u8>,
    related: Option<SampleIdentity>,
    has_call_header: bool,
}

impl From<Sample> for Arrived {
    fn from(sample: Sample) -> Self {
        Self {
            writer: sample.writer,
            sequence: sample.sequence,
            payload: sample.payload,
            related: sample.related,
            has_call_header: sample.has_call_header,
        }
    }
}

impl Recorded for Arrived {
    fn write(&self, out: &mut Vec<u8>) {
        let bytes = |guid: Guid| guid.to_bytes().to_vec();
        let related = self.related;
        let related = related.map(|related| (bytes(related.guid), related.sequence));
        (bytes(self.writer), self.sequence, related).write(out);
        self.payload.write(out);
        self.has_call_header.write(out);
    }

    fn read(input: &mut Input<'_>) -> Option<Self> {
        type Identity = (Vec<u8>, i64);
        let guid = |bytes: Vec<u8>| Some(Guid::from_bytes(bytes.try_into().ok()?));
        let (writer, sequence, related) = <(Vec<u8>, i64, Option<Identity>)>::read(input)?;
        let related = match related {
            Some((bytes, sequence)) => Some(SampleIdentity {
                guid: guid(bytes)?,
                sequence,
            }),
            None => None,
        };
        Some(Self {
            writer: guid(writer)?,
            sequence,
            payload: Recorded::read(input)?,
            related,
            has_call_header: Recorded::read(input)?,
        })
    }
}

/// Whose request a message is, and the message itself without what says so.
pub(super) fn request_of(sample: Arrived) -> Option<(Correlation, Vec<u8>)> {
    if sample.has_call_header {
        let (client, sequence, payload) = without_header(&sample)?;
        let related = SampleIdentity {
            guid: sample.writer,
            sequence: sample.sequence,
        };
        return Some((
            Correlation {
                related,
                header: (client, sequence),
            },
            payload,
        ));
    }
    // Clients name the reader that waits, or leave it to their writer.
    let asked = sample
        .related
        .map(|related| related.guid)
        .filter(|guid| *guid != Guid::default());
    let related = SampleIdentity {
        guid: asked.unwrap_or(sample.writer),
        sequence: sample.sequence,
    };
    Some((
        Correlation {
            related,
            header: (0, 0),
        },
        sample.payload,
    ))
}

/// The message of a reply, if it answers a request of this client.
pub(super) fn reply_to(sample: Arrived, own: [Guid; 2], client: u64) -> Option<(i64, Vec<u8>)> {
    if sample.has_call_header {
        let (whose, sequence, payload) = without_header(&sample)?;
        return (whose == client).then_some((sequence, payload));
    }
    let related = sample
        .related
        .filter(|related| own.contains(&related.guid))?;
    Some((related.sequence, sample.payload))
}

/// Client and number at the start of the payload, and the payload without them.
fn without_header(sample: &Arrived) -> Option<(u64, i64, Vec<u8>)> {
    let (head, rest) = sample.payload.split_first_chunk::<4>()?;
    let (client, rest) = rest.split_first_chunk::<8>()?;
    let (number, body) = rest.split_first_chunk::<8>()?;
    let (client, number) = match head[1] & 1 {
        1 => (u64::from_le_bytes(*client), i64::from_le_bytes(*number)),
        _ => (u64::from_be_bytes(*client), i64::from_be_bytes(*number)),
    };
    Some((client, number, [head, body].concat()))
}

/// The wall clock: peers compare it with theirs.
fn now() -> Timestamp {
    let seconds = wall_clock::unix_seconds();
    Timestamp {
        seconds: seconds as u32,
        fraction: (seconds.fract() * 4_294_967_296.0) as u32,
    }
}
