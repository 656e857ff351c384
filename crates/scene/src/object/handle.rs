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
    pub const WORLD: i64 = -1;
    pub const ALL: i64 = -2;
    pub const ALL_EXCEPT_EXPLICIT: i64 = -3;
    pub const SELF: i64 = -4;
    pub const MAIN_SCRIPT: i64 = -5;
    pub const TREE: i64 = -6;
    pub const CHAIN: i64 = -7;
    pub const SINGLE: i64 = -8;
    pub const PARENT: i64 = -11;
    pub const SCENE: i64 = -12;
    pub const APP: i64 = -13;
    pub const INVERSE: i64 = -14;
    pub const SCENE_OBJECT: i64 = -16;
    pub const APP_STORAGE: i64 = -15;
    pub const SANDBOX: i64 = -17;
    pub const MESH: i64 = -18;
}

/// Bits that may be added to an object handle (`sim.handleflag_*`). Several share a value: what a
/// bit means depends on the function it is given to.
pub mod flag {
    pub const KEEP_ORIGINAL: i64 = 0x40_0000;
    pub const REL_JOINT_BASE_FRAME: i64 = 0x40_0000;
    pub const RAW_VALUE: i64 = 0x100_0000;
    pub const AXIS: i64 = 0x40_0000;
    pub const WXYZ_QUATERNION: i64 = 0x100_0000;
    pub const RESET_FORCE: i64 = 0x40_0000;
    pub const ADD_MULTIPLE: i64 = 0x100_0000;
    pub const RESET_TORQUE: i64 = 0x80_0000;
    pub const GREYSCALE: i64 = 0x40_0000;
    pub const PACKED: i64 = 0x40_0000;
    pub const DEPTH_METRES: i64 = 0x80_0000;
    pub const DEPTH: i64 = 0x80_0000;
    pub const NO_CALLBACK: i64 = 0x100_0000;
}
