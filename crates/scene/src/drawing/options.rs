//! Types and flags of drawing objects (`sim.drawing_*`).

use bitflags::bitflags;

/// Kind of the items of a drawing object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DrawingKind {
    /// Points of a fixed size in pixels.
    Points,
    /// Lines between two end points.
    Lines,
    /// Triangles of three corners.
    Triangles,
    /// Small triangles at a point, with the direction they face.
    TrianglePoints,
    /// Small squares at a point, with the direction they face.
    QuadPoints,
    /// Small discs at a point, with the direction they face.
    DiscPoints,
    /// Small cubes at a point.
    CubePoints,
    /// Small spheres at a point.
    SpherePoints,
    /// A line through all items.
    LineStrip,
}

impl DrawingKind {
    /// The part of a type's number that is the kind; the bits above are [`DrawingFlags`].
    const MASK: i64 = 0x1f;

    /// The kind of a script's number. Triangles, quads, discs and cubes have one number from before 4.0 and one from after.
    pub fn from_code(code: i64) -> Option<Self> {
        Some(match code & Self::MASK {
            0 => Self::Points,
            1 => Self::Lines,
            2 => Self::Triangles,
            3 | 9 => Self::TrianglePoints,
            4 | 10 => Self::QuadPoints,
            5 | 11 => Self::DiscPoints,
            6 | 12 => Self::CubePoints,
            7 => Self::SpherePoints,
            8 => Self::LineStrip,
            _ => return None,
        })
    }

    /// How many points an item has.
    pub fn points(self) -> usize {
        match self {
            Self::Lines => 2,
            Self::Triangles => 3,
            _ => 1,
        }
    }

    /// Whether an item has a direction after its point. Cubes had one before 4.0.
    pub(super) fn has_normal(self, code: DrawingFlags) -> bool {
        match self {
            Self::TrianglePoints | Self::QuadPoints | Self::DiscPoints => {
                !code.contains(DrawingFlags::FACING_CAMERA)
            }
            Self::CubePoints => code.contains(DrawingFlags::OLD_CUBES),
            _ => false,
        }
    }
}

bitflags! {
    /// Flags in the type of a drawing object.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct DrawingFlags: i64 {
        /// Each item has a colour after its coordinates.
        const ITEM_COLOURS = 0x20;
        /// Each point of an item has a colour.
        const VERTEX_COLOURS = 0x40;
        /// Each item has a size after its colours.
        const ITEM_SIZES = 0x80;
        /// Faces are visible from the front only.
        const BACK_FACE_CULLING = 0x100;
        /// Only the edges of triangles are drawn.
        const WIREFRAME = 0x200;
        /// Visible to vision sensors that render all objects, not only to cameras (`sim.drawing_painttag`).
        const PAINT_TAG = 0x400;
        /// Visible only while the parent is.
        const WITH_PARENT_VISIBILITY = 0x800;
        /// A full object replaces its oldest item.
        const CYCLIC = 0x1000;
        /// Adds a transparency of 0.5.
        const TRANSPARENT_50 = 0x2000;
        /// Adds a transparency of 0.25.
        const TRANSPARENT_25 = 0x4000;
        /// Adds a transparency of 0.125.
        const TRANSPARENT_12 = 0x8000;
        /// Colours of items are what they emit.
        const EMISSION_COLOUR = 0x1_0000;
        /// Small bodies face the camera; items have no direction.
        const FACING_CAMERA = 0x2_0000;
        /// Drawn over everything else.
        const OVERLAY = 0x4_0000;
        /// Each item has a transparency, 0 to 1, as its last number.
        const ITEM_TRANSPARENCY = 0x8_0000;
        /// Outlives the script that created it.
        const PERSISTENT = 0x10_0000;
        /// Items come in the frame of the parent.
        const LOCAL = 0x80_0000;
        /// Cubes by their number from before 4.0, which have a direction.
        const OLD_CUBES = 0x4000_0000;
    }
}

impl DrawingFlags {
    /// The flags in a script's number.
    pub fn from_code(code: i64) -> Self {
        let mut flags = Self::from_bits_truncate(code);
        flags.set(Self::OLD_CUBES, code & DrawingKind::MASK == 6);
        flags
    }

    /// How much light passes through items without a transparency of their own, 0 to 1.
    pub fn transparency(self) -> f32 {
        let parts = [
            (Self::TRANSPARENT_50, 0.5),
            (Self::TRANSPARENT_25, 0.25),
            (Self::TRANSPARENT_12, 0.125),
        ];
        parts
            .into_iter()
            .filter(|(flag, _)| self.contains(*flag))
            .map(|(_, part)| part)
            .sum()
    }
}
