//! What a datagram does: its parts reach the readers and writers that they are for.

use std::collections::BTreeMap;
use std::net::SocketAddrV4;
use std::time::Duration;

use super::Core;
use crate::guid::{EntityId, Guid, Prefix};
use crate::message::{DataFragments, Message, Submessage, Timestamp};
use crate::reader::{Reader, sample};

/// Where a message came from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sender {
    pub(crate) prefix: Prefix,
    pub(crate) vendor: [u8; 2],
    pub(crate) from: SocketAddrV4,
    time: Option<Timestamp>,
}

impl Core {
    /// Takes a datagram. What is no message of the protocol, or not for this participant, has no effect.
    pub fn receive(&mut self, datagram: &[u8], from: SocketAddrV4, now: Duration) {
        self.now = now;
        let Some(message) = Message::parse(datagram) else {
            return;
        };
        let mut sender = Sender {
            prefix: message.prefix,
            vendor: message.vendor,
            from,
            time: None,
        };
        let mut is_for_us = true;
        for submessage in message {
            match submessage {
                Submessage::Destination(prefix) => {
                    is_for_us = prefix == self.settings.prefix || prefix == [0; 12];
                }
                Submessage::Source { vendor, prefix } => {
                    (sender.vendor, sender.prefix) = (vendor, prefix);
                }
                Submessage::Timestamp(time) => sender.time = time,
                _ if !is_for_us || sender.prefix == self.settings.prefix => {}
                other => self.submessage(other, sender),
            }
        }
        self.read_discovery();
    }

    fn submessage(&mut self, submessage: Submessage, sender: Sender) {
        let guid = |entity| Guid {
            prefix: sender.prefix,
            entity,
        };
        let out = &mut self.outgoing;
        match submessage {
            Submessage::Data(data) if data.writer == EntityId::PARTICIPANTS_WRITER => {
                self.participant_data(&data, sender);
            }
            Submessage::Data(data) => {
                let sample = sample(
                    guid(data.writer),
                    data.sequence,
                    sender.time,
                    data.payload.to_vec(),
                    &data.inline,
                );
                let sample = if data.is_key { sample.of_key() } else { sample };
                for reader in readers_of(&mut self.readers, data.reader, guid(data.writer)) {
                    reader.receive(guid(data.writer), sample.clone());
                }
            }
            Submessage::DataFragments(data) => self.fragments(&data, sender),
            Submessage::Heartbeat {
                reader,
                writer,
                first,
                last,
                is_final,
            } => {
                for reader in readers_of(&mut self.readers, reader, guid(writer)) {
                    reader.heartbeat(guid(writer), first, last, is_final, out);
                }
            }
            Submessage::Gap {
                reader,
                writer,
                first,
                base,
                more,
            } => {
                for reader in readers_of(&mut self.readers, reader, guid(writer)) {
                    reader.gap(guid(writer), first, base, &more);
                }
            }
            Submessage::AckNack {
                reader,
                writer,
                base,
                missing,
                is_final,
            } => {
                if let Some(writer) = self.writers.get_mut(&writer) {
                    writer.acknowledged(guid(reader), base, &missing, is_final, out);
                }
            }
            Submessage::NackFragments {
                reader,
                writer,
                sequence,
                missing,
            } => {
                if let Some(writer) = self.writers.get_mut(&writer) {
                    writer.resend_fragments(guid(reader), sequence, &missing, out);
                }
            }
            Submessage::Destination(_) | Submessage::Source { .. } | Submessage::Timestamp(_) => {}
        }
    }

    fn fragments(&mut self, data: &DataFragments, sender: Sender) {
        let writer = Guid {
            prefix: sender.prefix,
            entity: data.writer,
        };
        for reader in readers_of(&mut self.readers, data.reader, writer) {
            reader.receive_fragments(writer, data, sender.time);
        }
    }
}

/// The reader that is addressed, or all that know the writer.
fn readers_of(
    readers: &mut BTreeMap<EntityId, Reader>,
    addressed: EntityId,
    writer: Guid,
) -> impl Iterator<Item = &mut Reader> {
    readers
        .iter_mut()
        .filter(move |(entity, reader)| {
            (addressed == EntityId::UNKNOWN || **entity == addressed) && reader.has_writer(writer)
        })
        .map(|(_, reader)| reader)
}
