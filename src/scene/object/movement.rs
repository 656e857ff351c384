//! Permissions for moving an object in a user interface. Stored for scripts and files; there is no user interface.

use super::flags::{ForbiddenMovements, PreferredAxes};

/// How a user may move an object in an interface, and in which steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Movement {
    pub forbidden: ForbiddenMovements,
    /// Steps along (m) and about (rad) an axis; 0 for those of the application.
    pub step: [f64; 2],
    /// What translation and rotation refer to: 0 world, 1 parent, 2 the object itself.
    pub relativity: [i64; 2],
    pub preferred_axes: PreferredAxes,
}

impl Default for Movement {
    /// On the ground: along x and y of the world, about the own z.
    fn default() -> Self {
        Self {
            forbidden: ForbiddenMovements::empty(),
            step: [0.0; 2],
            relativity: [0, 2],
            preferred_axes: PreferredAxes::TRANSLATION_X | PreferredAxes::TRANSLATION_Y | PreferredAxes::ROTATION_Z,
        }
    }
}
