//! Option bits of the functions that create shapes.

use bitflags::bitflags;

bitflags! {
    /// Options of `sim.createPrimitiveShape`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct PrimitiveOptions: i64 {
        /// Faces are visible from the front only.
        const CULLING = 0x1;
        /// Faces are shaded flat.
        const SHARP_EDGES = 0x2;
        /// Cylinders and cones only.
        const OPEN_ENDS = 0x4;
        /// Only the mesh: for the physics it is no primitive.
        const PLAIN_MESH = 0x8;
        const _ = !0;
    }
}

bitflags! {
    /// Options of `sim.createPureShape`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct PureShapeOptions: i64 {
        /// Faces are visible from the front only.
        const CULLING = 0x1;
        /// Faces are shaded smoothly.
        const SMOOTH = 0x4;
        /// Collides with other respondable shapes.
        const RESPONDABLE = 0x8;
        /// Physics does not move it.
        const STATIC = 0x10;
        /// Cylinders and cones without their end faces.
        const OPEN_ENDS = 0x20;
        const _ = !0;
    }
}

impl PureShapeOptions {
    /// The options of the primitive behind it.
    pub fn primitive(self) -> PrimitiveOptions {
        let mut options = PrimitiveOptions::empty();
        options.set(PrimitiveOptions::CULLING, self.contains(Self::CULLING));
        options.set(PrimitiveOptions::SHARP_EDGES, !self.contains(Self::SMOOTH));
        options.set(PrimitiveOptions::OPEN_ENDS, self.contains(Self::OPEN_ENDS));
        options
    }
}

bitflags! {
    /// Options of `sim.createShape`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct MeshOptions: i64 {
        /// Faces are visible from the front only.
        const CULLING = 0x1;
        /// Edges are drawn.
        const EDGES = 0x2;
        /// The nearest pixel of the texture instead of bilinear filtering.
        const TEXTURE_NOT_INTERPOLATED = 0x4;
        /// The texture replaces the colour.
        const TEXTURE_AS_DECAL = 0x8;
        /// Pixels of the texture have an opacity.
        const TEXTURE_HAS_ALPHA = 0x10;
        /// Mirrors the image along x.
        const FLIP_TEXTURE_X = 0x20;
        /// The rows of the image begin at the bottom.
        const TEXTURE_FROM_BOTTOM = 0x40;
        /// Vertices in the same place are not merged.
        const KEEP_DUPLICATE_VERTICES = 0x80;
        const _ = !0;
    }
}

bitflags! {
    /// Options of `sim.createHeightfieldShape`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct HeightfieldOptions: i64 {
        /// Faces are visible from the front only.
        const CULLING = 0x1;
        /// Edges are drawn.
        const EDGES = 0x2;
        /// Only the mesh: for the physics it is no height field.
        const PLAIN_MESH = 0x4;
        /// Other shapes do not collide with it.
        const NOT_RESPONDABLE = 0x8;
        const _ = !0;
    }
}

bitflags! {
    /// Options of `sim.convexDecompose`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct DecompositionOptions: i64 {
        /// The shape itself changes.
        const MORPH = 0x1;
        const _ = !0;
    }
}

bitflags! {
    /// Options of `sim.generateShapeFromPath`.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct PathShapeOptions: i64 {
        /// The path is closed: its last pose stands for the first.
        const CLOSED = 0x4;
        const _ = !0;
    }
}
