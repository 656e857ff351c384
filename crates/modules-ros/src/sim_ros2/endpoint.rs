//! Writers and readers of the node. They end when they are dropped.

use std::rc::Rc;
use std::sync::Arc;

use ros_interfaces::{Layout, Record, cdr};
use rtps::{Correlation, EntityId, Guid, Qos, Sample, SampleIdentity, Timestamp, Written};

use super::names;
use super::node::Running;
use script::wall_clock;

/// A writer or reader.
pub(super) struct Endpoint {
    pub(super) node: Rc<Running>,
    pub(super) entity: EntityId,
}

impl Drop for Endpoint {
    fn drop(&mut self) {
        self.node.participant.with(|core| core.remove(self.entity));
    }
}

impl Endpoint {
    pub(super) fn writer(node: &Rc<Running>, topic: &str, layout: &Layout, qos: Qos) -> Self {
        let type_name = names::type_name(&layout.name);
        let entity = node
            .participant
            .with(|core| core.create_writer(topic, &type_name, qos, &[]));
        Self {
            node: node.clone(),
            entity,
        }
    }

    pub(super) fn reader(node: &Rc<Running>, topic: &str, layout: &Layout, qos: Qos) -> Self {
        let type_name = names::type_name(&layout.name);
        let entity = node
            .participant
            .with(|core| core.create_reader(topic, &type_name, qos, &[]));
        Self {
            node: node.clone(),
            entity,
        }
    }

    pub(super) fn take(&self) -> Option<Sample> {
        self.node.participant.with(|core| core.take(self.entity))
    }

    pub(super) fn waiting(&self) -> usize {
        self.node.participant.with(|core| core.waiting(self.entity))
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
        self.node
            .participant
            .with(|core| core.write(self.entity, &written));
    }

    /// Writes a request whose answer comes to `replies`. Returns its number.
    pub(super) fn request(&self, record: &Record, replies: &Self, client: u64) -> i64 {
        let payload: Arc<[u8]> = cdr::encode(record).into();
        self.node.participant.with(|core| {
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
        })
    }

    pub(super) fn guid(&self) -> Guid {
        self.node.participant.with(|core| core.guid(self.entity))
    }
}

/// Whose request a message is, and the message itself without what says so.
pub(super) fn request_of(sample: Sample) -> Option<(Correlation, Vec<u8>)> {
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
pub(super) fn reply_to(sample: Sample, own: [Guid; 2], client: u64) -> Option<(i64, Vec<u8>)> {
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
fn without_header(sample: &Sample) -> Option<(u64, i64, Vec<u8>)> {
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
