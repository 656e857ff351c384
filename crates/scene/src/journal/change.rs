//! Changes of a scene, and their topics.

use crate::{Handle, Holder, Namespace, Uid};

/// A changed aspect of an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Field {
    /// The name.
    Alias,
    /// The parent, or the place among the siblings.
    Parent,
    /// The pose in the parent's frame.
    Pose,
    /// Measured values and results of the physics: velocities, readings, flags. Measured velocities are noted only for those
    /// who follow them.
    Measured,
    /// The visibility layers.
    Layer,
    /// [`ObjectFlags`](crate::ObjectFlags).
    ObjectProperty,
    /// [`SpecialFlags`](crate::SpecialFlags).
    SpecialProperty,
    /// [`ModelFlags`](crate::ModelFlags).
    ModelProperty,
    /// What the physics reads of shapes, sensors and dummies, except for their geometry.
    Dynamics,
    /// Form and size.
    Geometry,
    /// Colours and other properties of surfaces.
    Appearance,
    /// The image on a mesh.
    Texture,
    /// Kind of joint: mode, limits, master.
    Joint,
    /// Motor of a joint: targets, gains, limits. The physics reads these in every sub-step.
    JointControl,
    /// Position and velocity of a joint, or the deviation of a force sensor's sides.
    JointPosition,
    /// Settings of a sensor or camera.
    Sensor,
    /// Text and settings of a script.
    Script,
    /// Execution priority.
    Priority,
    /// An inert value: stored for scripts, without an effect.
    Inert,
    /// Anything else.
    Other,
}

impl Field {
    /// Whether such a change can move the object in its parent's frame, or the frame its children live in.
    pub(crate) fn can_move(self) -> bool {
        use Field::*;
        matches!(
            self,
            Parent | Pose | Geometry | Joint | JointPosition | Other
        )
    }
}

/// One change, in the order it happened.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Change {
    /// An object was added.
    Added(Handle),
    /// An object was removed; its handle may be used again.
    Removed(Handle, Uid),
    /// An aspect of an object changed.
    Modified(Handle, Field),
    /// The selection changed.
    Selection,
    /// Settings or inert values of the scene changed.
    Settings,
    /// Custom data or a signal was written or removed: which of the two, the holder tells. Its name is without the mark of its type.
    Stored {
        /// Who holds the value.
        holder: Holder,
        /// Whether it is custom data or a signal.
        namespace: Namespace,
        /// Name of the value.
        name: String,
    },
}

impl Change {
    /// Topic of the change.
    pub fn topic(&self) -> Topic {
        match self {
            Self::Added(_) => Topic::Added,
            Self::Removed(..) => Topic::Removed,
            Self::Modified(_, field) => Topic::Field(*field),
            Self::Selection => Topic::Selection,
            Self::Settings => Topic::Settings,
            Self::Stored { .. } => Topic::Stored,
        }
    }
}

/// Topic of a change, without its object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Topic {
    /// [`Change::Added`].
    Added,
    /// [`Change::Removed`].
    Removed,
    /// [`Change::Modified`] of that aspect.
    Field(Field),
    /// [`Change::Selection`].
    Selection,
    /// [`Change::Settings`].
    Settings,
    /// [`Change::Stored`].
    Stored,
}

impl Topic {
    const FIELDS: usize = Field::Other as usize + 1;
    /// How many topics there are.
    pub(super) const COUNT: usize = Self::FIELDS + 5;

    /// Its number, below [`COUNT`](Self::COUNT).
    pub(super) const fn index(self) -> usize {
        match self {
            Self::Field(field) => field as usize,
            Self::Added => Self::FIELDS,
            Self::Removed => Self::FIELDS + 1,
            Self::Selection => Self::FIELDS + 2,
            Self::Settings => Self::FIELDS + 3,
            Self::Stored => Self::FIELDS + 4,
        }
    }
}

/// A set of topics.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Topics(u32);

impl Topics {
    /// No topic.
    pub const NONE: Self = Self(0);
    /// All topics.
    pub const ALL: Self = Self((1 << Topic::COUNT) - 1);
    /// Objects come, go, and get another parent or another place among their siblings.
    pub const TREE: Self = Self::NONE
        .with(Topic::Added)
        .with(Topic::Removed)
        .with_fields(&[Field::Parent]);

    /// These topics and one more.
    pub const fn with(self, topic: Topic) -> Self {
        Self(self.0 | 1 << topic.index())
    }

    /// These topics and changes of any of `fields`.
    pub const fn with_fields(mut self, fields: &[Field]) -> Self {
        let mut index = 0;
        while index < fields.len() {
            self = self.with(Topic::Field(fields[index]));
            index += 1;
        }
        self
    }

    /// The topics of either set.
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether `topic` is in the set.
    pub const fn contains(self, topic: Topic) -> bool {
        self.0 & 1 << topic.index() != 0
    }

    /// Whether there is a topic in both sets.
    pub const fn intersects(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// The topics of this set that are not in the other.
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether there is no topic in the set.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The numbers of its topics, rising.
    pub(super) fn indices(self) -> impl Iterator<Item = usize> {
        let rest = |bits: &u32| Some(bits & (bits - 1)).filter(|rest| *rest != 0);
        std::iter::successors(Some(self.0).filter(|bits| *bits != 0), rest)
            .map(|bits| bits.trailing_zeros() as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn topics_have_numbers_of_their_own() {
        let topics = [
            Topic::Added,
            Topic::Removed,
            Topic::Selection,
            Topic::Settings,
            Topic::Stored,
        ];
        let fields = [Field::Alias, Field::Pose, Field::Inert, Field::Other].map(Topic::Field);
        let mut seen = Topics::NONE;
        for topic in topics.into_iter().chain(fields) {
            assert!(!seen.contains(topic), "{topic:?}");
            seen = seen.with(topic);
        }
        assert_eq!(seen.indices().count(), 9);
        assert_eq!(
            Topics::ALL.indices().collect::<Vec<_>>(),
            (0..Topic::COUNT).collect::<Vec<_>>()
        );
        assert_eq!(Topics::NONE.indices().count(), 0);
    }
}
