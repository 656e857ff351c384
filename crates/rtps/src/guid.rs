//! Names of participants and of their writers and readers (DDSI-RTPS 2.3, 9.3.1).

use std::fmt;

/// The name of a participant.
pub type Prefix = [u8; 12];

/// A writer or reader within its participant; the last byte is its kind.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct EntityId(pub [u8; 4]);

impl EntityId {
    /// Nobody, or everybody who is concerned.
    pub const UNKNOWN: Self = Self([0; 4]);
    pub(crate) const PARTICIPANT: Self = Self([0, 0, 1, 0xc1]);
    pub(crate) const PARTICIPANTS_WRITER: Self = Self([0, 1, 0, 0xc2]);
    pub(crate) const PARTICIPANTS_READER: Self = Self([0, 1, 0, 0xc7]);
    pub(crate) const PUBLICATIONS_WRITER: Self = Self([0, 0, 3, 0xc2]);
    pub(crate) const PUBLICATIONS_READER: Self = Self([0, 0, 3, 0xc7]);
    pub(crate) const SUBSCRIPTIONS_WRITER: Self = Self([0, 0, 4, 0xc2]);
    pub(crate) const SUBSCRIPTIONS_READER: Self = Self([0, 0, 4, 0xc7]);
    pub(crate) const LIVELINESS_WRITER: Self = Self([0, 2, 0, 0xc2]);
    pub(crate) const LIVELINESS_READER: Self = Self([0, 2, 0, 0xc7]);

    /// A writer of a topic without keys.
    pub(crate) fn user_writer(number: u32) -> Self {
        Self::user(number, 0x03)
    }

    /// A reader of a topic without keys.
    pub(crate) fn user_reader(number: u32) -> Self {
        Self::user(number, 0x04)
    }

    fn user(number: u32, kind: u8) -> Self {
        let [_, a, b, c] = number.to_be_bytes();
        Self([a, b, c, kind])
    }

    /// Whether it is a reader, by its kind.
    pub(crate) fn is_reader(self) -> bool {
        matches!(self.0[3] & 0x0f, 0x04 | 0x07)
    }

    /// Whether it belongs to the protocol's own topics.
    pub(crate) fn is_builtin(self) -> bool {
        self.0[3] & 0xc0 == 0xc0
    }
}

impl fmt::Debug for EntityId {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{:08x}", u32::from_be_bytes(self.0))
    }
}

/// A writer or reader of the whole domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Guid {
    /// Its participant.
    pub prefix: Prefix,
    /// Which one of it.
    pub entity: EntityId,
}

impl Guid {
    /// The 16 bytes that are sent.
    pub fn to_bytes(self) -> [u8; 16] {
        let mut bytes = [0; 16];
        bytes[..12].copy_from_slice(&self.prefix);
        bytes[12..].copy_from_slice(&self.entity.0);
        bytes
    }

    /// Of the 16 bytes that were sent.
    pub fn from_bytes(bytes: [u8; 16]) -> Self {
        let (mut prefix, mut entity) = ([0; 12], [0; 4]);
        prefix.copy_from_slice(&bytes[..12]);
        entity.copy_from_slice(&bytes[12..]);
        Self {
            prefix,
            entity: EntityId(entity),
        }
    }
}

/// One message of a writer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct SampleIdentity {
    /// The writer, or by agreement the reader that waits for the answer.
    pub guid: Guid,
    /// The writer's number of the message, from 1.
    pub sequence: i64,
}
