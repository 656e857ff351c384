//! Pictures of triangle meshes, computed on the processor: colour, depth, and which object is seen in each pixel.
//!
//! This crate does not depend on a scene, files or a display. The same world has the same bytes on every machine and with every number of
//! threads.
//!
//! | to find | look at |
//! |---|---|
//! | what is drawn: instances of meshes, points, lines, lights, fog, background | [`World`], [`Mesh`], [`Material`], [`Texture`] |
//! | where it is seen from | [`Camera`], [`Projection`] |
//! | what comes out | [`Picture`], [`Channels`] |
//! | the passes | [`Renderer`] |
//! | cameras in numbers; culling, clipping and projecting | `projection` |
//! | which pixels a triangle covers; the visibility buffer | `coverage` |
//! | normals, light, textures, transparency, depth | `shading` |
//!
//! # Units and frames
//!
//! Metres and radians. A camera looks along its +Z, +Y is up and -X to the right. Rows of pictures go from the bottom up, pixels from left
//! to right. Triangles wind counter-clockwise seen from their front; back faces are drawn too, and lit from behind, unless a material is
//! culled. Colours are red, green, blue from 0 to 1, in 8 bits in pictures.
//!
//! # Method
//!
//! 1. Instances, and clusters of their triangles, are culled by bounding balls. Vertices are transformed with 64 bits; the eye is
//!    subtracted before anything is rotated. Triangles that cross the near plane or leave a guard band around the picture are clipped.
//! 2. Each pixel stores the closest triangle's number and how close it is: a visibility buffer (C. Burns and W. Hunt, *The visibility
//!    buffer: a cache-friendly approach to deferred shading*, 2013). Coverage is exact in integers, with the top-left rule, so that
//!    neighbours leave no gap and share no pixel. Back faces of closed meshes are left out, since front faces hide them.
//! 3. Ids, depths and colours are computed once for each visible pixel, by runs of one triangle in a row. Depths come from the plane of the
//!    triangle in 64 bits.
//!    Shadows are found by rays to the lights, through trees of boxes.
//! 4. Transparent surfaces, sharp edges and overlays become lists of fragments, sorted per pixel and blended from back to front.
//!    Transparent surfaces count in depths and ids as if they were opaque; sharp edges do not count.
//!
//! # Limits and determinism
//!
//! No function panics on any numbers: what is not finite is not drawn. Closed meshes that intersect themselves such that some of their
//! volume is inside out are drawn as if they were culled. Arithmetic uses the basic operations and `libm` only, which have the same
//! results everywhere; work is split into parts that do not depend on each other.
//!
//! ```
//! use geometry::Pose;
//! use rendering::*;
//!
//! let triangle = Mesh::new(&[[1.0, 0.0, 2.0], [-1.0, 0.0, 2.0], [0.0, 1.0, 2.0]], &[[0, 1, 2]], &[], &[]).expect("it has area");
//! let red = Material::unlit([1.0, 0.0, 0.0]);
//! let instances = [Instance { mesh: &triangle, pose: Pose::identity(), material: &red, id: 7 }];
//! let world = World { instances: &instances, ..World::EMPTY };
//! let camera = Camera {
//!     pose: Pose::identity(),
//!     projection: Projection::Perspective { angle: 1.0 },
//!     near: 0.1,
//!     far: 10.0,
//!     resolution: [64, 48],
//! };
//! let picture = Renderer::new(2).render(&world, &camera, Channels::ALL);
//! let above_the_middle = 28 * 64 + 32;
//! assert_eq!(picture.ids[above_the_middle], 7);
//! assert_eq!(picture.colour[3 * above_the_middle..][..3], [255, 0, 0]);
//! assert!((picture.depth[above_the_middle] - 1.9 / 9.9).abs() < 1e-6);
//! ```

#![cfg_attr(
    not(test),
    warn(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss
    )
)]

mod camera;
mod coverage;
mod material;
mod mesh;
mod parallel;
mod picture;
mod projection;
mod renderer;
mod shading;
mod texture;
mod three;
mod world;

pub use camera::{Camera, Projection};
pub use material::{Edges, Material};
pub use mesh::Mesh;
pub use picture::{Channels, Picture};
pub use renderer::Renderer;
pub use texture::{Image, Texture, TextureMode};
pub use world::{Background, Fog, FogDensity, Instance, Light, LightKind, Lines, Points, World};
