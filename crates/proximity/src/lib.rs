//! Proximity queries between triangle meshes, voxel grids and point sets: rays, nearest points inside a volume, distance, intersection.
//!
//! This crate knows no scene and no sensor. A geometry is built once, with a tree over it; a query gets it with a pose.
//!
//! | to find | look at |
//! |---|---|
//! | what can be queried | [`TriangleMesh`], [`VoxelGrid`], [`PointSet`], [`Geometry`], [`Placed`] |
//! | where a ray meets a surface | [`cast_ray`] |
//! | the nearest point in the volume of a sensor | [`closest_in_volume`] |
//! | distance and closest points of two geometries | [`distance()`] |
//! | whether they intersect, and along which segments | [`intersects`], [`intersection_segments`] |
//! | an index over many objects that move | [`BoundsTree`] |
//! | single boxes, triangles, segments | [`primitive`] |
//!
//! # Semantics
//!
//! Metres, radians; poses lead from a frame to the world. Meshes are surfaces: nothing is inside of them, and a small one inside a large one does
//! not intersect it. Voxels are solid cubes. Points have no extent. The front of a triangle is where it winds counter-clockwise; its normal points
//! there, and no query turns it.
//!
//! # Limits and determinism
//!
//! Coordinates are finite and at most 1e30; what is not is left out of geometries, and queries with such poses find nothing. No function panics
//! on any numbers. Everything is single-threaded, without hash maps and random numbers: the same input has the same bits on every run.
//!
//! ```
//! use geometry::{Pose, PrimitiveKind, primitive::tessellate};
//! use proximity::{Geometry, Placed, TriangleMesh, distance};
//!
//! let cube = tessellate(PrimitiveKind::Cuboid, [0.2; 3], false).expect("finite extents");
//! let mesh = TriangleMesh::new(&cube.vertices, &cube.triangles).expect("triangles with area");
//! let at = |x| Placed { geometry: Geometry::Mesh(&mesh), pose: Pose::translation(x, 0.0, 0.0) };
//! let closest = distance(at(0.0), at(1.0), f64::INFINITY).expect("no limit");
//! assert!((closest.distance - 0.8).abs() < 1e-12);
//! ```

mod bounds;
mod bounds_tree;
mod collision;
mod distance;
mod items;
mod mesh;
mod node_pair;
mod oriented;
mod placed;
mod points;
pub mod primitive;
mod ray;
mod tree;
mod volume;
mod voxels;

#[cfg(test)]
mod tests;

pub use bounds::Bounds;
pub use bounds_tree::BoundsTree;
pub use collision::{intersection_segments, intersects};
pub use distance::{Closest, distance};
pub use mesh::TriangleMesh;
pub use placed::{Geometry, Placed};
pub use points::PointSet;
pub use ray::{Filter, Hit, cast_ray};
pub use volume::{Piece, Volume, closest_in_volume};
pub use voxels::VoxelGrid;
