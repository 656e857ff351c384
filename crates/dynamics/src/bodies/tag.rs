//! What identifies a collider.

use scene::Handle;

use crate::plan::Surface;

/// Identifies a collider in callbacks: shape, root of its tree, mask.
#[derive(Clone, Copy)]
pub(crate) struct Tag {
    pub shape: Handle,
    pub root: Handle,
    pub mask: u16,
    /// Of the local mask, as many as [`scene::FURTHER_BITS`].
    pub further_bits: u64,
}

impl Tag {
    /// That of a shape with such a surface.
    pub(crate) fn new(shape: Handle, surface: &Surface) -> Self {
        Self {
            shape,
            root: surface.root,
            mask: surface.mask,
            further_bits: surface.further_bits,
        }
    }

    pub(crate) fn pack(self) -> u128 {
        let masks = u128::from(self.mask) << 64 | u128::from(self.further_bits) << 80;
        u128::from(self.shape.0) | u128::from(self.root.0) << 32 | masks
    }

    pub(crate) fn unpack(data: u128) -> Self {
        Self {
            shape: Handle(data as u32),
            root: Handle((data >> 32) as u32),
            mask: (data >> 64) as u16,
            further_bits: (data >> 80) as u64,
        }
    }
}
