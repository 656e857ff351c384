//! Mesh files as plain values: read with limits, and written.
//!
//! This crate knows no scene and opens no file. What a file refers to (materials, textures, buffers) the caller looks up ([`Resolve`]), so the
//! caller decides what may be opened.
//!
//! | format | read | written |
//! |---|---|---|
//! | OBJ with MTL | polygons, groups, materials, textures | yes |
//! | STL | text and binary, also binary files that begin with `solid` | text, binary |
//! | PLY | text and binary of both byte orders; lists, strips | text, binary |
//! | COLLADA | visual scene with its transforms, materials, textures, unit and up axis | yes |
//! | glTF, GLB | the scene with its transforms, materials, textures; no compression (Draco, meshopt) | GLB |
//! | glTF, GLB as nodes ([`gltf::Asset`]) | nodes, meshes, cameras, lights | text and GLB, animations too |
//! | 3DS | meshes, materials, textures | |
//! | DXF | `3DFACE`, polyface and polygon meshes of a text file | |
//!
//! Coordinates are `f64` in the file's own frame and unit; [`MeshFile::unit`] and [`MeshFile::up`] say which, [`MeshFile::turn_up`] and
//! [`MeshFile::scale`] change them. Normals and texture coordinates belong to the corners of triangles, so vertices merge by position alone.
//!
//! Counts in a file are compared with its length before anything is allocated, what instances add up to is limited ([`Limits`]), and so is the
//! length (256 MiB for COLLADA, glTF and DXF, else 2 GiB): memory is bounded by a multiple of the file's length and these limits. Any input is read or refused; nothing panics.
//!
//! # Why no library
//!
//! The formats are read by our own code because no crate that was tried does all three: read the nodes of a COLLADA scene (`mesh-loader`
//! leaves them out), stay small (`gltf` adds 39 packages), and compare every count in a file with the file's length before it allocates (none
//! does). Only XML is left to a library, `roxmltree`. Results were compared with `trimesh` and `pycollada` for 1993 meshes of pybullet and
//! example-robot-data.
//!
//! ```
//! use mesh_files::{MeshFormat, Limits, read};
//!
//! let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
//! let file = read(text, MeshFormat::Obj, Limits::default(), &mut |name| Err(format!("{name}: not looked for")))?;
//! assert_eq!(file.parts[0].vertices.len(), 4);
//! assert_eq!(file.parts[0].triangles.len(), 2);
//! # Ok::<(), mesh_files::ReadError>(())
//! ```

#![cfg_attr(
    not(test),
    warn(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        clippy::cast_sign_loss
    )
)]

mod bytes;
mod collada;
mod corners;
mod dxf;
mod error;
mod format;
pub mod gltf;
mod limits;
mod mesh_file;
mod obj;
mod ply;
mod polygon;
mod stl;
mod text;
mod three_ds;
mod transform;
mod weld;

pub use error::{Location, ReadError, WriteError};
pub use format::{ExportFormat, MeshFormat, Written, read, write};
pub use limits::Limits;
pub use mesh_file::{Material, MeshFile, Part, Texture, UpAxis};

/// Looks up a file that the mesh file names, by the name as written there: its bytes, or why it cannot be had.
pub type Resolve<'a> = &'a mut dyn FnMut(&str) -> Result<Vec<u8>, String>;
