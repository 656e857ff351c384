//! Rigid-body geometry: poses, triangle meshes, convex hulls and decomposition, mass properties, primitive solids.
//!
//! This crate does not depend on a scene, a physics engine or files. It computes values from values.
//!
//! | to find | look at |
//! |---|---|
//! | poses, quaternions, Euler angles, 3x4 matrices, interpolation | [`pose`] |
//! | velocities from two poses | [`pose::velocity`] |
//! | triangle meshes: checks, normals, islands, scaling, volume | [`Mesh`] |
//! | axis-aligned and tightest oriented bounding boxes | [`Mesh::bounding_box`], [`Mesh::oriented_box`] |
//! | convex hulls, grown hulls | [`Mesh::convex_hull`], [`Mesh::grown_hull`] |
//! | approximate convex decomposition | [`Mesh::convex_pieces`] |
//! | sweeping a cross-section along a path | [`Extrusion`] |
//! | mass, centre of mass, inertia | [`MassProperties`], [`mass`] |
//! | meshes of cuboids, spheres, cylinders, cones, capsules, height fields | [`primitive`] |
//! | whether numbers and poses are finite | [`Finite`] |
//! | groups of things that are connected | [`partition`] |
//!
//! # Units and frames
//!
//! Metres, radians, kilograms, seconds. Frames are right-handed. A [`Pose`] maps coordinates of a body's frame to its parent's frame.
//! Quaternions are written `[x, y, z, w]`; matrices are the upper 3x4 block in row-major order; Euler angles are alpha, beta, gamma with
//! `R = Rx(alpha) Ry(beta) Rz(gamma)` (intrinsic x-y'-z''). Triangles wind counter-clockwise seen from outside.
//! Inertia tensors of [`MassProperties`] are per unit mass and about the centre of mass.
//!
//! # Methods
//!
//! - Convex hulls are parry's, of points brought to unit extents first. The answer is checked: where it does not enclose its input, it is
//!   computed again with points merged more and more coarsely, up to 0.1 % of the size of the cloud.
//! - The oriented box is searched among boxes with one side flush with a face of the hull and another flush with an edge of the
//!   hull's projection along it; the planar step is the rotating-calipers argument of H. Freeman and R. Shapira, *Determining the
//!   minimum-area encasing rectangle for an arbitrary closed curve* (1975). The box of minimum volume may be tighter (J. O'Rourke,
//!   *Finding minimal enclosing boxes*, 1985).
//! - Convex decomposition is parry's V-HACD (K. Mamou and F. Ghorbel, *A simple and efficient approach for 3D mesh approximate convex
//!   decomposition*, 2009) on a mesh scaled to unit size.
//! - Mass properties of solids are sums over the signed tetrahedra between a point and the faces (F. Tonon, *Explicit exact formulas for
//!   the 3-D tetrahedron inertia tensor in terms of its vertex coordinates*, 2005).
//! - Connected groups are found by union-find with path halving, numbered in order of first appearance.
//!
//! # Limits and determinism
//!
//! No function panics on any numbers: what is not finite or has no extent is refused with an error or `None`, and rotations that cannot be
//! normalised become the identity. Everything is single-threaded and deterministic: the same input has the same bits on every run. No
//! result depends on the order of a hash map.
//!
//! ```
//! use geometry::{Mesh, Pose};
//! use geometry::primitive::{PrimitiveKind, tessellate};
//!
//! let mut mesh = tessellate(PrimitiveKind::Cuboid, [0.1, 0.2, 0.4], false).expect("finite extents");
//! mesh.append(&mesh.clone(), &Pose::translation(1.0, 0.0, 0.0));
//! assert_eq!(mesh.islands().len(), 2);
//! assert!((mesh.volume() - 2.0 * 0.008).abs() < 1e-12);
//!
//! let hull = Mesh::convex_hull(&mesh.vertices).expect("the points span a volume");
//! assert!((hull.volume() - 1.1 * 0.2 * 0.4).abs() < 1e-9);
//! ```

mod finite;
pub mod mass;
mod mesh;
pub mod pose;
pub mod primitive;
mod union_find;

pub use finite::Finite;
pub use mass::MassProperties;
pub use mesh::{BoundingBox, DecompositionParameters, Extrusion, MAX_COORDINATE, Mesh, MeshError};
pub use pose::{Pose, PoseError};
pub use primitive::PrimitiveKind;
pub use union_find::partition;
