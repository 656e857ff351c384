//! Permissions for moving an object by hand. Stored for scripts and files; there is no user interface.

/// What a hand may do to an object, and in which steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Movement {
    /// Bits of what is forbidden, see [`Movement::TRANSLATION_STOPPED`] and the following.
    pub options: i64,
    /// Steps along (m) and about (rad) an axis; 0 for those of the application.
    pub step: [f64; 2],
    /// What translation and rotation refer to: 0 world, 1 parent, 2 the object itself.
    pub relativity: [i64; 2],
    /// Preferred axes: bits 0 to 2 translation along x, y, z, bits 3 to 5 rotation about them.
    pub preferred_axes: i64,
}

impl Movement {
    pub const TRANSLATION_STOPPED: i64 = 0x1;
    pub const TRANSLATION_RUNNING: i64 = 0x2;
    pub const ROTATION_STOPPED: i64 = 0x4;
    pub const ROTATION_RUNNING: i64 = 0x8;
    pub const OTHER_TRANSLATIONS: i64 = 0x10;
    pub const OTHER_ROTATIONS: i64 = 0x20;
}

impl Default for Movement {
    /// On the ground: along x and y of the world, about the own z.
    fn default() -> Self {
        Self { options: 0, step: [0.0; 2], relativity: [0, 2], preferred_axes: 0x23 }
    }
}
