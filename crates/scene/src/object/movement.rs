//! Permissions for moving an object in a user interface. Stored for scripts and files; there is no user interface.

use super::flags::{ForbiddenMovements, PreferredAxes};

/// How a user may move an object in an interface, and in which steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Movement {
    /// Movements that are not offered.
    pub forbidden: ForbiddenMovements,
    /// Steps along (m) and about (rad) an axis; 0 for those of the application.
    pub step: [f64; 2],
    /// The frames of translation and of rotation.
    pub relativity: [MovementFrame; 2],
    /// Axes that are offered first.
    pub preferred_axes: PreferredAxes,
}

/// The frame of a movement. Other numbers are stored as written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MovementFrame(pub i64);

impl MovementFrame {
    /// The world frame.
    pub const WORLD: Self = Self(0);
    /// The frame of the parent.
    pub const PARENT: Self = Self(1);
    /// The object's own frame.
    pub const OWN: Self = Self(2);
}

impl Default for Movement {
    /// On the ground: along x and y of the world, about the own z.
    fn default() -> Self {
        Self {
            forbidden: ForbiddenMovements::empty(),
            step: [0.0; 2],
            relativity: [MovementFrame::WORLD, MovementFrame::OWN],
            preferred_axes: PreferredAxes::TRANSLATION_X
                | PreferredAxes::TRANSLATION_Y
                | PreferredAxes::ROTATION_Z,
        }
    }
}
