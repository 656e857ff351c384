//! Where a picture is taken from.

use geometry::Pose;

/// How rays leave the camera. The opening is that of the larger side of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Rays through one point.
    Perspective {
        /// Between the outermost rays, radians, below pi.
        angle: f64,
    },
    /// Parallel rays.
    Orthographic {
        /// Extent of what is visible, metres.
        size: f64,
    },
}

/// A camera: it looks along its +Z, +Y is up in the picture, and -X points to the right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// From the camera's frame to the world.
    pub pose: Pose,
    /// How rays leave the camera.
    pub projection: Projection,
    /// Depth where things begin to be visible, metres; above 0 in perspective.
    pub near: f64,
    /// Depth where they cease to be visible.
    pub far: f64,
    /// Width and height, pixels; sides beyond [`Camera::MAX_RESOLUTION`] are reduced to it.
    pub resolution: [u32; 2],
}

impl Camera {
    /// Largest side of a picture, pixels.
    pub const MAX_RESOLUTION: u32 = 4096;
}
