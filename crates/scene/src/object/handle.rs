//! Handles: how scripts and objects refer to objects.

/// Handle of a scene object: an index into the object store, 0 to 999999.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Handle(pub u32);

/// Application-wide identifier of an object, never given out twice in a session.
pub type Uid = i64;

impl Handle {
    /// One past the largest handle.
    pub const END: u32 = 1_000_000;
    /// The part of a number that is the plain handle; the bits above are `sim.handleflag_*`.
    pub const MASK: i64 = 0x003f_ffff;

    /// The handle a script means by `raw`, flag bits removed. Negative numbers are never handles.
    pub fn from_raw(raw: i64) -> Option<Self> {
        let plain = raw & Self::MASK;
        (raw >= 0 && plain < i64::from(Self::END)).then_some(Self(plain as u32))
    }

    /// The number scripts see.
    pub fn raw(self) -> i64 {
        i64::from(self.0)
    }

    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// Handles with a special meaning (`sim.handle_*`).
pub mod special {
    /// The world frame.
    pub const WORLD: i64 = -1;
    /// All objects, or all entities that a function is about.
    pub const ALL: i64 = -2;
    /// All that are not tagged for explicit handling.
    pub const ALL_EXCEPT_EXPLICIT: i64 = -3;
    /// The calling script.
    pub const SELF: i64 = -4;
    /// The main script.
    pub const MAIN_SCRIPT: i64 = -5;
    /// An object and everything below it.
    pub const TREE: i64 = -6;
    /// An object and everything above it.
    pub const CHAIN: i64 = -7;
    /// One object alone.
    pub const SINGLE: i64 = -8;
    /// The parent of the object.
    pub const PARENT: i64 = -11;
    /// The scene itself.
    pub const SCENE: i64 = -12;
    /// The application.
    pub const APP: i64 = -13;
    /// The inverse of the pose in the world frame.
    pub const INVERSE: i64 = -14;
    /// Any object, in event filters.
    pub const SCENE_OBJECT: i64 = -16;
    /// The values of the application that outlive a session.
    pub const APP_STORAGE: i64 = -15;
    /// The sandbox script.
    pub const SANDBOX: i64 = -17;
    /// Any mesh, in event filters.
    pub const MESH: i64 = -18;
}

/// Bits that may be added to an object handle (`sim.handleflag_*`). Several share a value: what a
/// bit means depends on the function it is given to.
pub mod flag {
    /// References that a copy shares with its original.
    pub const KEEP_ORIGINAL: i64 = 0x40_0000;
    /// A joint stands for its fixed side instead of its moving side.
    pub const REL_JOINT_BASE_FRAME: i64 = 0x40_0000;
    /// The unfiltered value of the last sub-step of the physics.
    pub const RAW_VALUE: i64 = 0x100_0000;
    /// Angular velocity as axis times angle per time instead of Euler angles.
    pub const AXIS: i64 = 0x40_0000;
    /// Quaternions with w first instead of last.
    pub const WXYZ_QUATERNION: i64 = 0x100_0000;
    /// A handle that does not exist is no error.
    pub const SILENT_ERROR: i64 = 0x200_0000;
    /// With an index: more results.
    pub const EXTENDED: i64 = 0x40_0000;
    /// Forces that were added before are dropped.
    pub const RESET_FORCE: i64 = 0x40_0000;
    /// Several drawing items are added at once.
    pub const ADD_MULTIPLE: i64 = 0x100_0000;
    /// Torques that were added before are dropped.
    pub const RESET_TORQUE: i64 = 0x80_0000;
    /// One grey level for each pixel instead of three colours.
    pub const GREYSCALE: i64 = 0x40_0000;
    /// Depths as a string of 32-bit floats.
    pub const PACKED: i64 = 0x40_0000;
    /// Depths in metres instead of 0 (near) to 1 (far).
    pub const DEPTH_METRES: i64 = 0x80_0000;
    /// Depths instead of an image.
    pub const DEPTH: i64 = 0x80_0000;
    /// No script is called.
    pub const NO_CALLBACK: i64 = 0x100_0000;
}
