//! Quality of service: what a writer offers, what a reader requests, and whether they fit (DDS 1.4, 2.2.3).

use std::time::Duration;

/// Whether lost messages are sent again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reliability {
    /// Each message is sent once.
    BestEffort,
    /// Lost messages are sent again.
    Reliable,
}

/// What readers get that come late.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Durability {
    /// What is written from then on.
    Volatile,
    /// What the writer keeps as well.
    TransientLocal,
    /// As transient local; a service beside the writer that keeps more is not offered.
    Transient,
    /// As transient.
    Persistent,
}

/// How many messages are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum History {
    /// The newest ones.
    KeepLast(usize),
    /// As many as [`Limits`](crate::Limits) allow.
    KeepAll,
}

/// Who says that a writer is alive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Liveliness {
    /// Its participant.
    Automatic,
    /// The program, for all writers of a participant.
    ManualByParticipant,
    /// The writer, by writing.
    ManualByTopic,
}

/// The policies of a writer or reader. `None` is a duration without end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Qos {
    /// Whether lost messages are sent again.
    pub reliability: Reliability,
    /// What late readers get.
    pub durability: Durability,
    /// How many messages are kept.
    pub history: History,
    /// The longest time between two messages.
    pub deadline: Option<Duration>,
    /// How long a message is valid.
    pub lifespan: Option<Duration>,
    /// Who says that a writer is alive.
    pub liveliness: Liveliness,
    /// How long a writer counts as alive.
    pub liveliness_lease: Option<Duration>,
}

impl Default for Qos {
    fn default() -> Self {
        Self {
            reliability: Reliability::Reliable,
            durability: Durability::Volatile,
            history: History::KeepLast(10),
            deadline: None,
            lifespan: None,
            liveliness: Liveliness::Automatic,
            liveliness_lease: None,
        }
    }
}

impl Qos {
    /// Whether a writer with these policies offers what a reader requests.
    pub fn offers(&self, requested: &Self) -> bool {
        self.reliability >= requested.reliability
            && self.durability >= requested.durability
            && is_within(self.deadline, requested.deadline)
            && self.liveliness >= requested.liveliness
            && is_within(self.liveliness_lease, requested.liveliness_lease)
    }

    pub(crate) fn is_reliable(&self) -> bool {
        self.reliability == Reliability::Reliable
    }

    pub(crate) fn is_durable(&self) -> bool {
        self.durability > Durability::Volatile
    }
}

fn is_within(offered: Option<Duration>, requested: Option<Duration>) -> bool {
    requested.is_none_or(|requested| offered.is_some_and(|offered| offered <= requested))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_writer_offers_at_least_what_a_reader_requests() {
        let default = Qos::default();
        let best_effort = Qos {
            reliability: Reliability::BestEffort,
            ..default
        };
        assert!(default.offers(&best_effort) && !best_effort.offers(&default));
        let durable = Qos {
            durability: Durability::TransientLocal,
            ..default
        };
        assert!(durable.offers(&default) && !default.offers(&durable));
        let often = Qos {
            deadline: Some(Duration::from_millis(10)),
            ..default
        };
        assert!(often.offers(&default) && !default.offers(&often) && often.offers(&often));
    }
}
