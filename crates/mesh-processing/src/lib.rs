//! Meshes and points processed: [`decimate`] makes meshes of fewer triangles, [`register`] moves points onto others, [`surface`]
//! makes a mesh of points, [`tetrahedra()`] fill a closed mesh, a [`KdTree`] finds points near
//! others. Coordinates are in any one unit.
//!
//! # Why no library
//!
//! The well-known libraries for this (OpenMesh, small_gicp) are C++, which the build would have to compile on every platform. The algorithms are a
//! few hundred lines each and need `nalgebra` only. `benches/compare/meshes.py` compares results and
//! times with trimesh, Qhull, fast-simplification and small_gicp.
//!
//! ```
//! use mesh_processing::{Target, decimate};
//!
//! // A square of four triangles around its middle needs two.
//! let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 0.0]];
//! let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
//! let (vertices, triangles) = decimate(&vertices, &triangles, Target { triangles: 2, ..Target::default() });
//! assert_eq!((vertices.len(), triangles.len()), (4, 2));
//! ```

#![cfg_attr(
    not(test),
    warn(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss
    )
)]

mod decimate;
mod kd_tree;
mod registration;
mod surface;
mod tetrahedra;

pub use decimate::{Target, Triangles, decimate};
pub use kd_tree::{KdTree, Neighbour};
pub use registration::{Registration, register};
pub use surface::{SurfaceOptions, surface};
pub use tetrahedra::{Tetrahedra, faces, grid, tetrahedra};
