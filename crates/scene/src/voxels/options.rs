//! Option bits of the functions of octrees and point clouds. Bits without a name have no effect.

use bitflags::bitflags;

bitflags! {
    /// Options of the creation of octrees and point clouds.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct StorageOptions: i64 {
        /// New voxels or points get random colours.
        const RANDOM_COLOURS = 0x2;
        /// The points of a point cloud are not stored in an octree.
        const WITHOUT_OCTREE = 0x8;
        const _ = !0;
    }
}

bitflags! {
    /// Options of insertion, removal and queries of points.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct PointOptions: i64 {
        /// Points are in the frame of the object, not of the world.
        const RELATIVE = 0x1;
        /// There is a colour, and a tag, for each point.
        const EACH = 0x2;
        const _ = !0;
    }
}
