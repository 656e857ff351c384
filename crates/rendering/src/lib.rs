//! Pictures of triangle meshes, computed on the processor: colour, depth, and which object is seen in each pixel.

mod camera;
mod lighting;
mod material;
mod mesh;
mod parallel;
mod picture;
mod raster;
mod renderer;
mod shade;
mod surface;
mod texture;
mod view;
mod world;

pub use camera::{Camera, Projection};
pub use material::{Edges, Material};
pub use mesh::Mesh;
pub use picture::{Channels, Picture};
pub use renderer::Renderer;
pub use texture::{Image, Texture, TextureMode};
pub use world::{Background, Fog, FogDensity, Instance, Light, LightKind, Lines, Points, World};
